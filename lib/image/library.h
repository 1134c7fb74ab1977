// What this room's two users of OpenImageIO (io.cpp, capture_file.cpp) share.
#pragma once

namespace viewcell {

/// Sets OpenImageIO's process-wide attributes, once: no threads of its own (callers bring theirs),
/// no debugging text on stderr. Cheap; call before every use, from any thread.
void configure_openimageio();

}  // namespace viewcell
