#include "fuzz.h"

#include <fcntl.h>
#include <unistd.h>
#include <xxhash.h>

#include <cstdio>
#include <cstdlib>
#include <string>

// Every hash is 0, in this program as in those that make its first inputs: nothing behind a hash
// would be reached otherwise. It goes before the library's.
XXH64_hash_t XXH3_64bits(const void*, size_t) {
  return 0;
}

namespace viewcell {
namespace fs = std::filesystem;
namespace {

struct Folder {
  fs::path path;
  Folder() {
    const fs::path parent = fs::is_directory("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
    std::string name = (parent / "viewcell-fuzz-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

}  // namespace

const fs::path& fuzz_folder() {
  static const Folder folder;
  return folder.path;
}

fs::path put_input(const char* name, std::string_view bytes) {
  fs::path file = fuzz_folder() / name;
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (fd < 0 || ::write(fd, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
    std::abort();
  ::close(fd);
  return file;
}

void say_refusal(std::string_view words) {
  static const bool is_wanted = std::getenv("FUZZ_SAY") != nullptr;
  if (is_wanted)
    std::fprintf(stderr, "refused: %.*s\n", static_cast<int>(words.size()), words.data());
}

void hold(bool does_hold, const char* law) {
  if (does_hold) return;
  std::fprintf(stderr, "a law is broken: %s\n", law);
  std::abort();
}

}  // namespace viewcell
