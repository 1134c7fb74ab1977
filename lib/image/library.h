// What this room's two users of OpenImageIO (io.cpp, capture_file.cpp) share.
#pragma once

#include <stdexcept>
#include <string>

#include "base/error.h"

namespace viewcell {

/// Sets OpenImageIO's process-wide attributes, once: no threads of its own (callers bring theirs),
/// no debugging text on stderr. Cheap; call before every use, from any thread.
void configure_openimageio();

/// The first line of what OpenImageIO says, for errors: it may say more, and ends in a newline.
std::string first_line(const std::string& text);

/// call(), whose answer is given. The library's readers throw std::length_error where a header says
/// absurd things: that is the file's fault.
template <typename Call>
bool call_library(const std::string& file, const Call& call) {
  try {
    return call();
  } catch (const std::logic_error& error) {  // length_error, out_of_range
    throw InputError(file, "header",
                     std::string("is no picture that can be read: ") + error.what());
  }
}

}  // namespace viewcell
