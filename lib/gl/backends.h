// The two ways to a context. Their libraries' headers stay in the files that wrap them.
#pragma once

#include <memory>

#include "gl/context.h"

namespace viewcell {

/// Each throws MachineError with the reason. The context made is current.
std::unique_ptr<GlBackend> make_osmesa_backend();
std::unique_ptr<GlBackend> make_egl_backend();

/// dlopen with the message turned into a MachineError. The library stays open to the end of the
/// process: Mesa's threads and exit handlers do not survive dlclose.
void* open_library(const char* soname, const char* debian_package);
/// dlsym; throws MachineError.
void* find_symbol(void* library, const char* soname, const char* name);

}  // namespace viewcell
