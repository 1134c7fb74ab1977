#include "gl/gl.h"

#include <cstdio>

#include "base/error.h"

namespace viewcell {

Gl load_gl(const GlLoader& loader) {
  Gl gl;
#define VIEWCELL_GL_LOAD(Name, NAME)                                 \
  gl.Name = reinterpret_cast<PFNGL##NAME##PROC>(loader("gl" #Name)); \
  if (!gl.Name) throw MachineError("GL: the driver has no function gl" #Name);
  VIEWCELL_GL_STATE(VIEWCELL_GL_LOAD)
  VIEWCELL_GL_OBJECTS(VIEWCELL_GL_LOAD)
  VIEWCELL_GL_DRAWING(VIEWCELL_GL_LOAD)
#undef VIEWCELL_GL_LOAD
  return gl;
}

void check_gl(const Gl& gl, const std::string& place) {
  const GLenum first = gl.GetError();
  if (first == GL_NO_ERROR) return;
  while (gl.GetError() != GL_NO_ERROR) {
  }
  if (first == GL_OUT_OF_MEMORY) throw MachineError("GL: out of memory: " + place);
  char code[16];
  std::snprintf(code, sizeof code, "0x%04X", first);
  throw BugError("GL: error " + std::string(code) + ": " + place);
}

}  // namespace viewcell
