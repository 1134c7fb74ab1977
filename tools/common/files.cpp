#include "common/files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "base/error.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

// A device, a pipe, or what stands in /dev.
bool is_special(const std::string& path) {
  if (path == "-" || path.starts_with("/dev/")) return true;
  std::error_code ignored;  // what is not there is no device
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

bool is_standard(const std::string& path, const char* device) {
  return path == "-" || path == device;
}

// Where a path leads, links followed, whether or not it is there.
std::string follow(const fs::path& path) {
  std::error_code ignored;
  std::string out = fs::weakly_canonical(fs::absolute(path, ignored), ignored).string();
  while (out.size() > 1 && out.back() == '/') out.pop_back();
  return out;
}

// Stars in patterns; in a path a star is a star.
constexpr char kInName = '\1', kAnyDepth = '\2';

bool is_star(char c) {
  return c == kInName || c == kAnyDepth;
}

bool swallows(char star, char c) {
  return star == kAnyDepth || (star == kInName && c != '/');
}

// Whether some path fits both.
bool can_meet(std::string_view a, std::string_view b) {
  if (a.empty() && b.empty()) return true;
  if (!a.empty() && is_star(a[0]) && can_meet(a.substr(1), b)) return true;
  if (!b.empty() && is_star(b[0]) && can_meet(a, b.substr(1))) return true;
  if (a.empty() || b.empty()) return false;
  if (a[0] == b[0] && !is_star(a[0])) return can_meet(a.substr(1), b.substr(1));
  return (swallows(a[0], b[0]) && can_meet(a, b.substr(1))) ||
         (swallows(b[0], a[0]) && can_meet(a.substr(1), b));
}

std::string make_pattern(const std::string& folder, const std::string& inside) {
  std::string out = folder + "/";
  for (const char c : inside) {
    if (c != '*')
      out += c;
    else if (out.back() == kInName)
      out.back() = kAnyDepth;
    else
      out += kInName;
  }
  return out;
}

// A file or folder, and the paths that are read or written there.
struct Place {
  explicit Place(const NamedFile& named_file) : named(named_file), special(is_special(named.path)) {
    if (named.path.empty() || special) return;
    path = follow(named.path);
    if (!is_folder()) patterns = {path};
    for (const std::string& inside : named.inside) patterns.push_back(make_pattern(path, inside));
  }
  bool is_folder() const { return !named.inside.empty(); }

  const NamedFile& named;
  bool special;
  std::string path;  // empty: not given, or special
  std::vector<std::string> patterns;
};

std::vector<Place> find_places(const std::vector<NamedFile>& files) {
  return {files.begin(), files.end()};
}

bool is_same(const Place& a, const Place& b) {
  const std::string &one = a.named.path, &other = b.named.path;
  if (one.empty() || other.empty() || one == "-" || other == "-") return false;
  std::error_code ignored;
  if (fs::equivalent(one, other, ignored))
    return fs::is_regular_file(one, ignored) || fs::is_directory(one, ignored);
  return !a.special && !b.special && a.path == b.path;
}

bool can_meet(const Place& a, const Place& b) {
  for (const std::string& one : a.patterns)
    for (const std::string& other : b.patterns)
      if (can_meet(one, other)) return true;
  return false;
}

void check_streams(const std::vector<NamedFile>& files, const char* device, const char* stream) {
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (is_standard(files[k].path, device) && is_standard(files[i].path, device))
        throw UsageError(files[k].name + " and " + files[i].name + " cannot both be " + stream);
}

void check_output(const Place& output, const Place& input) {
  const std::string &out = output.named.name, &in = input.named.name;
  if (is_same(output, input)) throw UsageError(out + " is " + in);
  if (can_meet(output, input)) throw UsageError(out + " would write over " + in);
}

void check_outputs(const Place& a, const Place& b) {
  const std::string both = a.named.name + " and " + b.named.name;
  if (!(a.is_folder() && b.is_folder()) && is_same(a, b)) throw UsageError(both + " are one file");
  if (can_meet(a, b)) throw UsageError(both + " would write the same file");
}

}  // namespace

void check_files(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  for (const NamedFile& output : outputs)
    if (output.path == "-" && !output.inside.empty())
      throw UsageError(output.name + " names a folder");
  check_streams(inputs, "/dev/stdin", "standard input");
  check_streams(outputs, "/dev/stdout", "standard output");
  const std::vector<Place> read = find_places(inputs), written = find_places(outputs);
  for (std::size_t i = 0; i < written.size(); ++i) {
    for (const Place& input : read) check_output(written[i], input);
    for (std::size_t k = 0; k < i; ++k) check_outputs(written[k], written[i]);
  }
}

void check_places(const std::vector<NamedFile>& outputs) {
  const std::vector<Place> places = find_places(outputs);
  const auto is_made = [&](const fs::path& folder) {
    const std::string path = follow(folder) + "/";
    return std::any_of(places.begin(), places.end(), [&](const Place& place) {
      return place.is_folder() && (place.path + "/").starts_with(path);
    });
  };
  for (const Place& place : places) {
    if (place.path.empty() || place.is_folder()) continue;
    const fs::path file = place.named.path;
    std::error_code error;
    if (fs::is_directory(file, error))
      throw MachineError(file.string() + ": cannot write: is a folder");
    const fs::path folder = file.parent_path();
    if (!folder.empty() && !fs::is_directory(folder, error) && !is_made(folder))
      throw MachineError(file.string() + ": cannot write: '" + folder.string() + "' is no folder");
  }
}

void check_ending(const NamedFile& output, const std::vector<std::string>& endings,
                  const std::string& what) {
  if (output.path.empty() || is_special(output.path)) return;
  std::string ending = fs::path(output.path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::find(endings.begin(), endings.end(), ending) != endings.end()) return;
  std::string all;
  for (const std::string& one : endings) all += (all.empty() ? "" : " or ") + one;
  throw UsageError(output.name + " is " + what + ": it does not end in " + all);
}

}  // namespace viewcell
