// Hundreds of damaged, exchanged and hostile bundles, each played for two frames: the same
// pictures, or a stand-in that is said, or a refusal; never other pictures without a word, never a
// crash.
#include <gtest/gtest.h>

#include <set>

#include "bake/bundle_copy.h"
#include "base/section_file.h"
#include "common/mutate.h"
#include "play/session.h"

namespace viewcell {
namespace {
namespace fs = std::filesystem;

constexpr CellId kMutatedCell{4};

struct Outcome {
  std::string refusal;  // empty: it was played
  std::vector<std::string> faults;
  std::vector<ImageRgba8> pictures;
};

// From the middle of a cell towards objects outside it.
std::vector<Camera> make_cameras() {
  const CellSet& cells = shared_bake().cells;
  std::vector<Camera> cameras(2);
  for (std::size_t i = 0; i < 2; ++i) {
    cameras[i].eye = eye_of(cells, kMutatedCell);
    cameras[i].forward =
        glm::normalize(shared_bake().scene.objects[i + 2].translation - cameras[i].eye);
  }
  return cameras;
}

Outcome play_bundle(const fs::path& folder) {
  Outcome out;
  try {
    const Bundle bundle(folder, {.n_threads = 1});
    PlayerOptions options;
    options.width_px = options.height_px = 32;
    options.n_threads = 1;
    options.residency = {.pool_texels = 1u << 20, .prefetch = false};
    Player player(bundle, options);
    for (const Camera& camera : make_cameras()) {
      player.draw(Mode::hybrid, camera);
      out.pictures.push_back(player.read(Mode::hybrid));
    }
    for (const BundleFault& fault : player.residency().faults()) out.faults.push_back(fault.what);
  } catch (const InputError& error) {
    out.refusal = error.what();
  }
  return out;
}

// All files of a bundle, by their paths in its folder.
std::map<std::string, std::string> read_files(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder)] = read_file(entry.path());
  return files;
}

// A file's bytes and what its sections say; sections may be changed and the whole put together
// again with the right hashes.
struct Sections {
  std::uint32_t kind = 0;
  std::vector<std::pair<std::string, std::string>> parts;  // tag, bytes

  explicit Sections(const std::string& bytes) {
    std::uint32_t n = 0;
    std::memcpy(&kind, bytes.data() + 8, 4);
    std::memcpy(&n, bytes.data() + 12, 4);
    for (std::size_t i = 0; i < n; ++i) {
      const char* entry = bytes.data() + 16 + 32 * i;
      std::uint64_t offset = 0, size = 0;
      std::memcpy(&offset, entry + 8, 8);
      std::memcpy(&size, entry + 16, 8);
      parts.emplace_back(std::string(entry, ::strnlen(entry, 8)), bytes.substr(offset, size));
    }
  }
  std::string write(const fs::path& file) const {
    SectionWriter writer(kind);
    for (const auto& [tag, bytes] : parts) writer.add_bytes(tag, bytes);
    return hash_hex(writer.write(file));
  }
  std::string& part(const std::string& tag) {
    for (auto& [name, bytes] : parts)
      if (name == tag) return bytes;
    throw BugError("no section " + tag);
  }
};

// Mutates a bundle in place and mends it again.
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed), whole_(read_files(copy_.path())) {
    std::set<std::string> needed = {cell_name(kMutatedCell)};  // by the frames that are drawn
    for (const CentreId centre : views_of(shared_bake().cells.grid, kMutatedCell))
      needed.insert(centre_name(centre));
    for (const auto& [name, bytes] : whole_) {
      const bool has_sections = name.ends_with(".geo") || name.ends_with(".tex");
      const bool is_needed = !has_sections || needed.contains(name.substr(name.find('/') + 1));
      for (int n = is_needed ? 6 : 1; n > 0; --n) {
        names_.push_back(name);
        if (has_sections) sections_.push_back(name);
      }
    }
  }

  fs::path path() const { return copy_.path(); }
  void mend() {
    move_bake(Json::parse(whole_.at(kManifestName)));
    for (const std::string& name : changed_) put(name, whole_.at(name));
    changed_.clear();
  }
  // Returns what was done.
  std::string mutate_once() {
    switch (random_.below(9)) {
      case 0:
        return change("bytes of", [&](std::string bytes) { return mutate(bytes, random_); });
      case 1:
        return change("a bit of", [&](std::string bytes) {
          bytes[at(bytes.size())] ^= static_cast<char>(1u << random_.below(8));
          return bytes;
        });
      case 2:
        return change("the end of",
                      [&](const std::string& bytes) { return bytes.substr(0, at(bytes.size())); });
      case 3:
        return change("zeros in", [&](std::string bytes) {
          const std::size_t first = at(bytes.size());
          return bytes.replace(first, 1 + at(bytes.size() - first), std::string(9, '\0'));
        });
      case 4:
        return exchange();
      case 5:
        return duplicate();
      case 6:
        return swap_sections();
      default:
        return be_hostile();
    }
  }

 private:
  std::size_t at(std::size_t n) { return random_.below(static_cast<std::uint32_t>(n)); }
  const std::string& pick(const std::vector<std::string>& names) { return names[at(names.size())]; }
  void put(const std::string& name, const std::string& bytes) {
    fs::remove(copy_.path() / name);  // some file systems flush one that is rewritten
    put_bytes(copy_.path() / name, bytes);
  }
  void mark(const std::string& name) { changed_.push_back(name); }
  // To where the manifest says.
  void move_bake(const Json& manifest) {
    const fs::path to = path() / ("bake-" + manifest.at("hash").get<std::string>());
    for (const auto& entry : fs::directory_iterator(path()))
      if (entry.is_directory() && entry.path() != to) return fs::rename(entry.path(), to);
  }

  template <typename Change>
  std::string change(const char* what, const Change& change) {
    const std::string name = pick(names_);
    mark(name);
    put(name, change(whole_.at(name)));
    return std::string(what) + " " + name;
  }
  std::string exchange() {
    const std::string a = pick(sections_), b = pick(sections_);
    mark(a), mark(b);
    put(a, whole_.at(b));
    put(b, whole_.at(a));
    return a + " and " + b + " exchanged";
  }
  std::string duplicate() {
    const std::string a = pick(sections_), b = pick(sections_);
    mark(a);
    put(a, whole_.at(b));
    return a + " is a copy of " + b;
  }
  // Their names change places; hashes are right.
  std::string swap_sections() {
    const std::string name = pick(sections_);
    Sections sections(whole_.at(name));
    auto &a = sections.parts[at(sections.parts.size())],
         &b = sections.parts[at(sections.parts.size())];
    std::swap(a.first, b.first);
    return write(name, sections, "sections " + a.first + " and " + b.first + " swapped in");
  }
  // A value that no bake has, hashes right; every other time in the manifest, too.
  std::string be_hostile() {
    const std::string name = pick(sections_);
    Sections sections(whole_.at(name));
    const std::string what =
        name.ends_with(".geo") ? spoil_geometry(sections) : spoil_textures(sections);
    return write(name, sections, what + " in");
  }
  std::string write(const std::string& name, const Sections& sections, const std::string& what) {
    mark(name);
    fs::remove(copy_.path() / name);
    const std::string hash = sections.write(copy_.path() / name);
    if (random_.below(2) == 0) return what + " " + name;
    mark(kManifestName);
    Json manifest = Json::parse(whole_.at(kManifestName));
    manifest["files"][name.substr(name.find('/') + 1)] = hash;
    seal_manifest(manifest);
    put(kManifestName, manifest.dump());
    move_bake(manifest);
    return what + " " + name + " and in the manifest";
  }

  // Changes one record of a section; nothing where there is none.
  template <typename Record, typename Change>
  std::string spoil(Sections& sections, const char* tag, const Change& change) {
    std::string& bytes = sections.part(tag);
    const std::size_t n = bytes.size() / sizeof(Record);
    if (n == 0) return "nothing";
    Record record;
    char* where = bytes.data() + at(n) * sizeof(Record);
    std::memcpy(static_cast<void*>(&record), where, sizeof record);
    change(record);
    std::memcpy(where, static_cast<const void*>(&record), sizeof record);
    return std::string("a hostile value of ") + tag;
  }
  double no_number() {
    const double bad[] = {std::nan(""), HUGE_VAL, -HUGE_VAL};
    return bad[random_.below(3)];
  }
  std::string spoil_geometry(Sections& s) {
    switch (random_.below(4)) {
      case 0:
        return spoil<std::uint32_t>(s, "VERTICES", [](std::uint32_t& v) { v = ~0u; });
      case 1:
        return spoil<std::uint32_t>(s, "INDICES", [](std::uint32_t& i) { i = 1u << 30; });
      case 2:
        return spoil<std::uint8_t>(s, "VIEWS", [](std::uint8_t& v) { v = 0xff; });
      default:
        return spoil<BundleObject>(s, "OBJECTS", [&](BundleObject& o) {
          const std::uint32_t k = random_.below(6);
          if (k == 0) o.object = -1;
          if (k == 1) o.kind = 7;
          if (k == 2) o.n_vertices = ~0u;
          if (k == 3) ++o.n_triangles;
          if (k == 4) o.lo[random_.below(3)] = static_cast<float>(no_number());
          if (k == 5) o.hi[random_.below(3)] = -1e30f;
        });
    }
  }
  std::string spoil_textures(Sections& s) {
    return spoil<BundleTile>(s, "TILES", [&](BundleTile& t) {
      double* const numbers[] = {&t.eye[0],   &t.right[1],   &t.up[2],     &t.forward[0],
                                 &t.focal_px, &t.code_scale, &t.code_bias, &t.forward[2]};
      const std::uint32_t k = random_.below(14);
      if (k < 8) *numbers[k] = no_number();
      if (k == 8) t.object = 1 << 20;
      if (k == 9) t.width_px = -t.width_px, t.height_px = -t.height_px;
      if (k == 10) t.first_texel += 1;
      if (k == 11) t.focal_px = -t.focal_px;
      if (k == 12) t.right[0] = -t.right[0] - 1;
      if (k == 13) t.height_px += 1;
    });
  }

  Random random_;
  BundleCopy copy_;
  std::map<std::string, std::string> whole_;
  std::vector<std::string> names_, sections_, changed_;
};

void expect_no_silent_wrong(std::uint64_t seed, int n) {
  Mutator mutator(seed);
  const Outcome expected = play_bundle(mutator.path());
  ASSERT_EQ(expected.refusal, "");
  ASSERT_TRUE(expected.faults.empty()) << expected.faults[0];
  int n_same = 0, n_said = 0, n_refused = 0;
  for (int i = 0; i < n; ++i) {
    const std::string what = mutator.mutate_once();
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", mutation " << i << ": " << what);
    const Outcome out = play_bundle(mutator.path());
    n_refused += !out.refusal.empty();
    n_said += !out.faults.empty();
    n_same += out.refusal.empty() && out.faults.empty();
    if (!out.refusal.empty()) {
      EXPECT_NE(out.refusal.find(mutator.path().string()), std::string::npos) << out.refusal;
    } else if (out.faults.empty()) {
      ASSERT_EQ(out.pictures.size(), expected.pictures.size());
      for (std::size_t k = 0; k < out.pictures.size(); ++k)
        ASSERT_EQ(out.pictures[k].pixels, expected.pictures[k].pixels);
    }
    mutator.mend();
  }
  EXPECT_EQ(play_bundle(mutator.path()).pictures[0].pixels, expected.pictures[0].pixels);
  for (const int kind : {n_same, n_said, n_refused}) EXPECT_GT(kind, n / 10);
}

TEST(BundleMutations, NeverAnotherPictureWithoutAWord) {
  expect_no_silent_wrong(41, 120);
}

TEST(SlowBundleMutations, NeverAnotherPictureWithoutAWord) {
  expect_no_silent_wrong(42, 1500);
}

}  // namespace
}  // namespace viewcell
