// What this room's two users of OpenImageIO (io.cpp, capture_file.cpp) share.
#pragma once

#include <string>

namespace viewcell {

/// Sets OpenImageIO's process-wide attributes, once: no threads of its own (callers bring theirs),
/// no debugging text on stderr. Cheap; call before every use, from any thread.
void configure_openimageio();

/// The first line of what OpenImageIO says, for errors: it may say more, and ends in a newline.
std::string first_line(const std::string& text);

}  // namespace viewcell
