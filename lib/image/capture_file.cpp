#include "image/capture_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "image/exr_layout.h"
#include "image/half.h"
#include "image/header.h"
#include "image/library.h"

namespace viewcell {
namespace {

constexpr const char* kEmptyName = "empty";
constexpr const char* kNoteName = "viewcellPart";
// zip at level 2: 0.16 s a megapixel and 5.6 bytes a pixel on bumpy statues; level 4 takes 0.2 s
// for 2 % less, level 6 twice the time; rle takes 0.06 s for 9 bytes, zips and piz lose both ways.
constexpr const char* kCompression = "zip:2";
// zlib turns one byte into at most 1032.
constexpr std::uint64_t kMostExrInflation = 1032;

// A pixel as OpenImageIO hands it over: the file's channels in the order R, G, B, A, Z.
struct Pixel {
  std::array<std::uint16_t, 4> rgba_half;
  float z;
};
static_assert(sizeof(Pixel) == 12);

std::size_t n_pixels(const CapturePartHeader& h) {
  return static_cast<std::size_t>(h.width_px) * static_cast<std::size_t>(h.height_px);
}

bool is_attribute_name(const std::string& name) {
  if (name.empty() || !std::islower(static_cast<unsigned char>(name[0]))) return false;
  for (const char c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) return false;
  return true;
}

// --- writing ---

void check_part(const CapturePart& part, const CapturePartHeader& first) {
  const CapturePartHeader& h = part.header;
  VIEWCELL_CHECK(!h.name.empty() && h.name != kEmptyName, h.name);
  VIEWCELL_CHECK(h.source_width_px > 0 && h.source_height_px > 0, h.name);
  VIEWCELL_CHECK(
      h.source_width_px == first.source_width_px && h.source_height_px == first.source_height_px,
      h.name, "has another display window than the first part");
  VIEWCELL_CHECK(h.width_px > 0 && h.height_px > 0 && h.width_px <= kMaxImageSidePx &&
                     h.height_px <= kMaxImageSidePx,
                 h.name, h.width_px, h.height_px);
  VIEWCELL_CHECK(part.rgba_half.size() == 4 * n_pixels(h) && part.z.size() == n_pixels(h), h.name,
                 part.rgba_half.size(), part.z.size(), h.width_px, h.height_px);
  for (const std::uint16_t half : part.rgba_half)
    VIEWCELL_CHECK(is_finite_half(half), "colour of", h.name);
  for (const float z : part.z) VIEWCELL_CHECK(std::isfinite(z), "depth of", h.name);
}

void check_input(const std::vector<CapturePart>& parts, const CaptureAttributes& attributes) {
  std::set<std::string> names;
  for (const CapturePart& part : parts) {
    check_part(part, parts.front().header);
    VIEWCELL_CHECK(names.insert(part.header.name).second, "two parts are named", part.header.name);
  }
  for (const auto& [name, text] : attributes)
    VIEWCELL_CHECK(
        is_attribute_name(name) && name != kNoteName && name != "name" && name != "compression",
        name);
}

CapturePart empty_part() {
  CapturePart part{{kEmptyName, 1, 1, 0, 0, 1, 1, glm::dmat4(1), glm::dmat4(1), ""}, {}, {}};
  part.rgba_half.assign(4, 0);
  part.z.assign(1, 0.f);
  return part;
}

void set_matrix(OIIO::ImageSpec& spec, const char* name, const glm::dmat4& matrix) {
  const glm::mat4 rounded(matrix);
  spec.attribute(name, OIIO::TypeMatrix, &rounded[0][0]);
}

OIIO::ImageSpec make_spec(const CapturePartHeader& h) {
  OIIO::ImageSpec spec(h.width_px, h.height_px, 5, OIIO::TypeHalf);
  spec.channelnames = {"R", "G", "B", "A", "Z"};
  spec.channelformats = {OIIO::TypeHalf, OIIO::TypeHalf, OIIO::TypeHalf, OIIO::TypeHalf,
                         OIIO::TypeFloat};
  spec.alpha_channel = 3;
  spec.z_channel = 4;
  spec.x = h.x;
  spec.y = h.y;
  spec.full_x = spec.full_y = 0;
  spec.full_width = h.source_width_px;
  spec.full_height = h.source_height_px;
  spec.attribute("compression", kCompression);
  spec.attribute("name", h.name);
  set_matrix(spec, "worldToCamera", h.world_to_camera);
  set_matrix(spec, "worldToNDC", h.world_to_ndc);
  if (!h.note.empty()) spec.attribute(kNoteName, h.note);
  // Without a DateTime the writer adds today's; one of the wrong type keeps it from doing so and is
  // itself not written.
  spec.attribute("DateTime", 0);
  return spec;
}

std::vector<Pixel> interleave(const CapturePart& part) {
  std::vector<Pixel> pixels(part.z.size());
  for (std::size_t p = 0; p < pixels.size(); ++p) {
    std::memcpy(pixels[p].rgba_half.data(), &part.rgba_half[4 * p], 8);
    pixels[p].z = part.z[p];
  }
  return pixels;
}

// A file in memory. The library takes file names where there are several parts: it is given one
// that leads to nothing on disk, and the bytes are then written as all files are.
class FileInMemory {
 public:
  FileInMemory() : fd_(::memfd_create("capture", MFD_CLOEXEC)) {
    if (!fd_.is_open()) throw MachineError("cannot make a file in memory: " + errno_text());
  }
  std::string name() const { return "/proc/self/fd/" + std::to_string(fd_.get()); }
  std::string read() const {
    std::string bytes(static_cast<std::size_t>(std::max<off_t>(0, ::lseek(fd_.get(), 0, SEEK_END))),
                      '\0');
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t n =
          ::pread(fd_.get(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
      if (n <= 0) throw MachineError("cannot read a file in memory: " + errno_text());
      done += static_cast<std::size_t>(n);
    }
    return bytes;
  }

 private:
  Descriptor fd_;
};

// The writer's last flush tells no one when there was no room.
bool is_whole(const FileInMemory& file) {
  const Stream stream(std::fopen(file.name().c_str(), "rbe"));
  if (!stream) return false;
  try {
    check_exr_layout(stream.get(), file.name());
    return true;
  } catch (const InputError&) {
    return false;
  }
}

bool write_parts(OIIO::ImageOutput& output, const std::string& file,
                 const std::vector<const CapturePart*>& parts,
                 const std::vector<OIIO::ImageSpec>& specs) {
  if (!output.open(file, static_cast<int>(specs.size()), specs.data())) return false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0 && !output.open(file, specs[i], OIIO::ImageOutput::AppendSubimage)) return false;
    if (!output.write_image(OIIO::TypeUnknown, interleave(*parts[i]).data())) return false;
  }
  return output.close();
}

// --- reading ---

glm::dmat4 matrix_of(const OIIO::ImageSpec& spec, const char* name, const std::string& file,
                     const std::string& place) {
  const OIIO::ParamValue* value = spec.find_attribute(name, OIIO::TypeMatrix);
  if (!value) throw InputError(file, place, std::string("has no matrix ") + name);
  glm::mat4 matrix;
  std::memcpy(&matrix[0][0], value->data(), sizeof matrix);
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!std::isfinite(matrix[column][row]))
        throw InputError(file, place, std::string("matrix ") + name + " is not finite");
  return glm::dmat4(matrix);
}

void check_channels(const OIIO::ImageSpec& spec, const std::string& file,
                    const std::string& place) {
  const std::vector<std::string> names = {"R", "G", "B", "A", "Z"};
  bool right = spec.channelnames == names && !spec.deep && spec.tile_width == 0;
  for (int c = 0; right && c < 5; ++c)
    right = spec.channelformat(c) == (c < 4 ? OIIO::TypeHalf : OIIO::TypeFloat);
  if (!right)
    throw InputError(file, place, "its channels are not R, G, B, A as half and Z as float");
}

CapturePartHeader read_header(const OIIO::ImageSpec& spec, std::size_t i, const std::string& file) {
  CapturePartHeader h;
  h.name = spec.get_string_attribute("oiio:subimagename", spec.get_string_attribute("name"));
  const std::string place = "part " + std::to_string(i);
  if (h.name.empty()) throw InputError(file, place, "has no name");
  check_channels(spec, file, place);
  if (spec.full_x != 0 || spec.full_y != 0 || spec.full_width < 1 || spec.full_height < 1)
    throw InputError(file, place, "its display window does not begin at (0, 0)");
  h.source_width_px = spec.full_width;
  h.source_height_px = spec.full_height;
  h.x = spec.x;
  h.y = spec.y;
  h.width_px = spec.width;
  h.height_px = spec.height;
  h.world_to_camera = matrix_of(spec, "worldToCamera", file, place);
  h.world_to_ndc = matrix_of(spec, "worldToNDC", file, place);
  h.note = spec.get_string_attribute(kNoteName);
  return h;
}

CaptureAttributes read_attributes(const OIIO::ImageSpec& spec) {
  CaptureAttributes attributes;
  for (const OIIO::ParamValue& value : spec.extra_attribs) {
    const std::string name = value.name().string();
    if (value.type() == OIIO::TypeString && is_attribute_name(name) && name != "name" &&
        name != "compression" && name != kNoteName)
      attributes[name] = value.get_string(0);
  }
  return attributes;
}

// What reading would allocate, against what the file's bytes can hold.
void check_total(const std::vector<CapturePartHeader>& parts, std::uint64_t size,
                 const std::string& file) {
  std::uint64_t n_bytes = 0;
  for (const CapturePartHeader& h : parts) n_bytes += n_pixels(h) * sizeof(Pixel);
  if (n_bytes / kMostExrInflation > size)
    throw InputError(
        file, "header",
        std::to_string(n_bytes) + " bytes of pixels in a file of " + std::to_string(size));
}

}  // namespace

void write_capture_file(const std::filesystem::path& file, const std::vector<CapturePart>& parts,
                        const CaptureAttributes& attributes) {
  check_input(parts, attributes);
  configure_openimageio();
  const CapturePart none = empty_part();
  std::vector<const CapturePart*> written;
  for (const CapturePart& part : parts) written.push_back(&part);
  if (written.empty()) written.push_back(&none);
  std::vector<OIIO::ImageSpec> specs;
  for (const CapturePart* part : written) specs.push_back(make_spec(part->header));
  for (const auto& [name, text] : attributes) specs[0].attribute(name, text);

  const FileInMemory memory;
  const auto output = OIIO::ImageOutput::create("openexr");
  if (!output) throw MachineError("OpenImageIO cannot write OpenEXR");
  if (!write_parts(*output, memory.name(), written, specs) || !is_whole(memory))
    throw MachineError(file.string() +
                       ": cannot write: memory or the limit of file sizes (ulimit -f) ends");
  write_file(file, memory.read());
}

// Members die in the right order: the reader reads from the stream, by way of the proxy.
struct CaptureFile::Input {
  Stream stream;
  std::unique_ptr<OIIO::Filesystem::IOFile> proxy;
  std::unique_ptr<OIIO::ImageInput> file;
};

CaptureFile::CaptureFile(const std::filesystem::path& path)
    : name_(path.string()), input_(std::make_unique<Input>()) {
  configure_openimageio();
  refuse_special(path);
  if (std::filesystem::is_directory(path)) throw InputError(name_, "", "is a folder, not a file");
  input_->stream.reset(std::fopen(path.c_str(), "rbe"));
  if (!input_->stream) throw InputError(name_, "", "cannot open: " + errno_text());
  const std::uint64_t size = check_exr_layout(input_->stream.get(), name_);
  input_->proxy = std::make_unique<OIIO::Filesystem::IOFile>(input_->stream.get(),
                                                             OIIO::Filesystem::IOProxy::Read);
  input_->file = OIIO::ImageInput::create("openexr", false);
  if (!input_->file || !input_->file->set_ioproxy(input_->proxy.get()))
    throw MachineError("OpenImageIO cannot read OpenEXR");
  OIIO::ImageInput& input = *input_->file;
  OIIO::ImageSpec spec;
  if (!input.open(name_, spec, OIIO::ImageSpec()))
    throw InputError(name_, "", first_line(input.geterror()));
  const int n_parts = spec.get_int_attribute("oiio:subimages", 1);
  attributes_ = read_attributes(spec);
  for (int i = 0; i < n_parts; ++i) {
    if (!input.seek_subimage(i, 0))
      throw InputError(name_, "part " + std::to_string(i), first_line(input.geterror()));
    parts_.push_back(read_header(input.spec(), static_cast<std::size_t>(i), name_));
  }
  check_total(parts_, size, name_);
  if (parts_.size() == 1 && parts_[0].name == kEmptyName) parts_.clear();
}

CaptureFile::~CaptureFile() = default;
CaptureFile::CaptureFile(CaptureFile&&) noexcept = default;
CaptureFile& CaptureFile::operator=(CaptureFile&&) noexcept = default;

CapturePart CaptureFile::read_part(std::size_t i) {
  VIEWCELL_CHECK(i < parts_.size(), i, "of", parts_.size());
  CapturePart part{parts_[i], {}, {}};
  const std::size_t n = n_pixels(part.header);
  const std::string place = "part " + std::to_string(i) + " (" + part.header.name + ")";
  std::vector<Pixel> pixels(n);
  if (!input_->file->read_image(static_cast<int>(i), 0, 0, 5, OIIO::TypeUnknown, pixels.data()))
    throw InputError(name_, place, first_line(input_->file->geterror()));
  part.rgba_half.resize(4 * n);
  part.z.resize(n);
  bool finite = true;
  for (std::size_t p = 0; p < n; ++p) {
    std::memcpy(&part.rgba_half[4 * p], pixels[p].rgba_half.data(), 8);
    part.z[p] = pixels[p].z;
    for (const std::uint16_t half : pixels[p].rgba_half) finite = finite && is_finite_half(half);
    finite = finite && std::isfinite(pixels[p].z);
  }
  if (!finite) throw InputError(name_, place, "holds a number that is not finite");
  return part;
}

}  // namespace viewcell
