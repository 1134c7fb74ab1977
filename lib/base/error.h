// The three kinds of error (docs/architecture.md): the input's fault, the machine's fault, a bug of
// ours. lib/ throws them; only tools/ print them and turn them into exit codes.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace viewcell {

/// The input is at fault: exit code 1. The message is one line, "file: place: what is wrong".
class InputError : public std::runtime_error {
 public:
  /// place may be empty ("object 17", "line 3", "byte 120").
  /// Control characters, which come from the input, become spaces.
  InputError(const std::string& file, const std::string& place, const std::string& what)
      : std::runtime_error(one_line(file + (place.empty() ? "" : ": " + place) + ": " + what)) {}

 private:
  static std::string one_line(std::string text) {
    for (char& c : text)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    return text;
  }
};

/// The command line is at fault: exit code 2.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The machine is at fault (disk, memory, GL): exit code 3.
class MachineError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A check of our own failed: exit code 4.
class BugError : public std::logic_error {
  using std::logic_error::logic_error;
};

/// Throws BugError with the text of the condition and the values given.
template <typename... Values>
[[noreturn]] void throw_bug(const char* file, int line, const char* condition,
                            const Values&... values) {
  std::ostringstream text;
  text << file << ":" << line << ": check failed: " << condition;
  ((text << " " << values), ...);
  throw BugError(text.str());
}

}  // namespace viewcell

/// VIEWCELL_CHECK(i < n, "i =", i, "n =", n): an invariant of ours; prints its values.
#define VIEWCELL_CHECK(condition, ...)                                                  \
  do {                                                                                  \
    if (!(condition))                                                                   \
      ::viewcell::throw_bug(__FILE__, __LINE__, #condition __VA_OPT__(, ) __VA_ARGS__); \
  } while (false)
