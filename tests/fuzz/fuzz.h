// What the fuzzers share: a reader is given each input as a file, and what it takes must keep the
// reader's laws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "base/error.h"

namespace viewcell {

/// A folder of this process, in memory where there is /dev/shm; removed at the end.
const std::filesystem::path& fuzz_folder();

/// The input as a file of that folder. Not synced.
std::filesystem::path put_input(const char* name, std::string_view bytes);

/// Aborts, which is a finding, where a law does not hold.
void hold(bool does_hold, const char* law);

/// Prints it where FUZZ_SAY is set: to see why an input is refused.
void say_refusal(std::string_view words);

/// Whether read() takes its input. A refusal is an InputError whose words are one line; whatever
/// else is thrown is a finding.
template <typename Read>
bool is_taken(const Read& read) {
  try {
    read();
    return true;
  } catch (const InputError& error) {
    const std::string_view text = error.what();
    hold(!text.empty() && text.find('\n') == text.npos, "an error is one line");
    say_refusal(text);
    return false;
  }
}

inline std::string_view view_of(const std::uint8_t* data, std::size_t n_bytes) {
  return {reinterpret_cast<const char*>(data), n_bytes};
}

}  // namespace viewcell

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes);
