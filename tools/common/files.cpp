#include "common/files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

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

// Files that need not be there.
bool is_same_file(const std::string& a, const std::string& b) {
  if (a == "-" || b == "-") return false;
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return fs::is_regular_file(a, ignored);
  if (is_special(a) || is_special(b)) return false;
  return fs::weakly_canonical(fs::absolute(a, ignored), ignored) ==
         fs::weakly_canonical(fs::absolute(b, ignored), ignored);
}

void check_pair(const NamedFile& a, const NamedFile& b, const char* device, const char* stream) {
  if (is_standard(a.path, device) && is_standard(b.path, device))
    throw UsageError(a.name + " and " + b.name + " cannot both be " + stream);
}

}  // namespace

void check_files(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  for (std::size_t i = 0; i < inputs.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      check_pair(inputs[k], inputs[i], "/dev/stdin", "standard input");
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const NamedFile& output = outputs[i];
    if (output.path.empty()) continue;
    for (const NamedFile& input : inputs)
      if (!input.path.empty() && is_same_file(input.path, output.path))
        throw UsageError(output.name + " is " + input.name);
    for (std::size_t k = 0; k < i; ++k) {
      check_pair(outputs[k], output, "/dev/stdout", "standard output");
      if (!outputs[k].path.empty() && is_same_file(outputs[k].path, output.path))
        throw UsageError(outputs[k].name + " and " + output.name + " are one file");
    }
  }
}

void check_places(const std::vector<NamedFile>& outputs) {
  for (const NamedFile& output : outputs) {
    if (output.path.empty() || is_special(output.path)) continue;
    std::error_code error;
    if (fs::is_directory(output.path, error))
      throw MachineError(output.path + ": cannot write: is a folder");
    const fs::path folder = fs::path(output.path).parent_path();
    if (!folder.empty() && !fs::is_directory(folder, error))
      throw MachineError(output.path + ": cannot write: '" + folder.string() + "' is no folder");
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
