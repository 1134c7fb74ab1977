#include "picture_seeds.h"

#include <OpenImageIO/imageio.h>

#include <stdexcept>

#include "base/file.h"
#include "formats/write_glb.h"
#include "image/capture_file.h"
#include "image/half.h"
#include "image/index_map.h"
#include "image/io.h"
#include "mesh/cube.h"

namespace viewcell {
namespace {

void write_picture(const std::filesystem::path& file, int n_channels, const char* option,
                   const char* value) {
  constexpr int kSidePx = 5;
  const auto out = OIIO::ImageOutput::create(file.string());
  OIIO::ImageSpec spec(kSidePx, kSidePx, n_channels, OIIO::TypeDesc::UINT8);
  spec.attribute(option, value);
  std::vector<std::uint8_t> samples(std::size_t{kSidePx} * kSidePx *
                                    static_cast<std::size_t>(n_channels));
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<std::uint8_t>(7 * i);
  if (!out || !out->open(file.string(), spec) ||
      !out->write_image(OIIO::TypeDesc::UINT8, samples.data()) || !out->close())
    throw std::runtime_error("OpenImageIO cannot write " + file.string());
}

void add_captures(const Seeds& seeds) {
  std::vector<CapturePart> parts;
  for (int i = 0; i < 2; ++i) {
    CapturePart part{{"object " + std::to_string(i), 64, 64, i, -1, 3, 2, glm::dmat4(1),
                      glm::dmat4(1), R"({"focal_px": 88})"},
                     {},
                     {}};
    part.rgba_half.assign(24, half_from_float(1));
    part.z.assign(6, 10.5f);
    parts.push_back(part);
  }
  write_capture_file(seeds.file("capture", "two.exr"), parts, {{"key", "0000000000000000"}});
  write_capture_file(seeds.file("capture", "none.exr"), {}, {{"key", "0000000000000000"}});
}

// With pictures of two kinds.
void add_textured_glb(const Seeds& seeds) {
  TriMesh mesh = make_cube();
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c)
    mesh.texcoords.emplace_back(c % 4 * 0.25f, c % 3 * 0.5f);
  mesh.normals = make_vertex_normals(mesh);
  GlbOptions options;
  options.base_color = encode_png(ImageRgba8(2, 2, {1, 2, 3, 255}));
  options.normal_map = read_file(seeds.file("picture", "rgb.jpg"));
  const auto file = seeds.file("texture", "textured.glb");
  write_glb(file, mesh, options);
  seeds.add("glb", "textured.glb", read_file(file));
}

}  // namespace

void add_pictures(const Seeds& seeds) {
  for (const char* ending :
       {"png", "jpg", "exr", "tif", "webp", "gif", "bmp", "tga", "ppm", "hdr"}) {
    write_picture(seeds.file("picture", std::string("rgb.") + ending), 3, "compression", "");
  }
  for (const char* ending : {"png", "exr", "tif", "webp", "tga"})
    write_picture(seeds.file("picture", std::string("rgba.") + ending), 4, "compression", "");
  for (const char* way : {"lzw", "zip", "packbits", "none"})
    write_picture(seeds.file("picture", std::string(way) + ".tif"), 3, "compression", way);
  for (const char* way : {"none", "rle", "zips", "piz", "pxr24", "b44", "dwaa"})
    write_picture(seeds.file("picture", std::string(way) + ".exr"), 3, "compression", way);
  write_picture(seeds.file("picture", "rle.tga"), 3, "compression", "rle");
  IndexMap map(4, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) map.at(x, y) = own_texcoords(x, y, 4, 3);
  write_index_map(seeds.file("index_map", "a.exr"), map, "a mesh");
  write_index_map(seeds.file("index_map", "a.tif"), map, "a mesh");
  add_captures(seeds);
  add_textured_glb(seeds);
}

}  // namespace viewcell
