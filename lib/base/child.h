// Work in a process of its own: for libraries that are not made for damaged bytes.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace viewcell {

struct ChildLimits {
  std::size_t memory_bytes = 1u << 26;  ///< beside what this process has
  int cpu_s = 2;                        ///< of the processor
  int wall_s = 120;                     ///< on the wall, where it waits for what never comes
};

/// Memory that a child process writes and this one reads. Zeros at first.
class SharedBytes {
 public:
  /// Throws MachineError.
  explicit SharedBytes(std::size_t n_bytes);
  ~SharedBytes();
  SharedBytes(const SharedBytes&) = delete;
  SharedBytes& operator=(const SharedBytes&) = delete;
  std::span<std::byte> bytes() const { return {data_, n_bytes_}; }

 private:
  std::byte* data_;
  std::size_t n_bytes_;
};

/// Forks; the child calls work(), which hands over what it makes in SharedBytes, and ends without
/// more ado. A crash, an exception, or more memory or time than allowed ends the child alone.
/// Returns nothing if all went well, else what went wrong, in words: an exception's text, or how
/// the child ended. Any thread may call it; of this process' threads the child has that one alone.
/// Milliseconds, plus the work. Throws MachineError where no process can be made.
std::string run_in_child(const ChildLimits& limits, const std::function<void()>& work);

}  // namespace viewcell
