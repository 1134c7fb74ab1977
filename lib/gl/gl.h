// The table of OpenGL 4.5 core functions. Whoever draws is handed one by a GlContext: there is no
// other way to reach GL, and no GL without a context passed in.
#pragma once

#include <GL/glcorearb.h>

#include <functional>
#include <string>

#include "gl/functions.h"

namespace viewcell {

/// Called as gl.Clear(...) for glClear(...). Every pointer is set. Valid while its context lives,
/// and only on the thread on which that context is current.
struct Gl {
#define VIEWCELL_GL_MEMBER(Name, NAME) PFNGL##NAME##PROC Name = nullptr;
  VIEWCELL_GL_STATE(VIEWCELL_GL_MEMBER)
  VIEWCELL_GL_OBJECTS(VIEWCELL_GL_MEMBER)
  VIEWCELL_GL_DRAWING(VIEWCELL_GL_MEMBER)
#undef VIEWCELL_GL_MEMBER
};

/// A function's address by its full name ("glClear"); null when unknown.
using GlLoader = std::function<void (*(const char* name))()>;

/// Fills the table. Throws MachineError naming the first function that is missing. A loader may
/// return junk for unknown names (OSMesa does): check GL_VERSION before trusting the table.
Gl load_gl(const GlLoader& loader);

/// Throws when a GL call before this one failed: MachineError for lack of memory, else BugError.
/// place: what was being done, for the message. Waits for nothing.
void check_gl(const Gl& gl, const std::string& place);

}  // namespace viewcell
