#include "gl/context.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>

#include "base/error.h"
#include "base/parallel.h"
#include "gl/backends.h"

namespace viewcell {
namespace {

constexpr int kMostLlvmpipeThreads = 32;  // LP_MAX_THREADS of Mesa 22.3

std::string gl_string(const Gl& gl, GLenum name) {
  const GLubyte* text = gl.GetString(name);
  return text ? reinterpret_cast<const char*>(text) : "";
}

// Asked before the table is trusted: a loader may return junk for names that it does not know.
void require_version(const GlLoader& loader) {
  const auto get_integer = reinterpret_cast<PFNGLGETINTEGERVPROC>(loader("glGetIntegerv"));
  if (!get_integer) throw MachineError("GL: the driver has no function glGetIntegerv");
  GLint major = 0, minor = 0;
  get_integer(GL_MAJOR_VERSION, &major);
  get_integer(GL_MINOR_VERSION, &minor);
  if (major < 4 || (major == 4 && minor < 5))
    throw MachineError("GL: version 4.5 is needed, the driver has " + std::to_string(major) + "." +
                       std::to_string(minor));
}

// Mesa itself reads the variable; here it is only told on.
int count_raster_threads(const std::string& renderer) {
  if (renderer.find("softpipe") != std::string::npos) return 1;
  if (renderer.find("llvmpipe") == std::string::npos) return 0;
  int n = hardware_threads();
  if (const char* text = std::getenv("LP_NUM_THREADS")) n = std::atoi(text);
  return std::clamp(n, 1, kMostLlvmpipeThreads);
}

void set_house_state(const Gl& gl) {
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GREATER);
  gl.ClearDepth(0);
  gl.FrontFace(GL_CCW);
  gl.CullFace(GL_BACK);
  gl.Enable(GL_CULL_FACE);
  gl.Disable(GL_DITHER);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

}  // namespace

GlEngine parse_gl_engine(const std::string& name) {
  if (name == "osmesa") return GlEngine::kOsmesa;
  if (name == "egl") return GlEngine::kEgl;
  throw UsageError("GL engine '" + name + "' is unknown: osmesa or egl");
}

void* open_library(const char* soname, const char* debian_package) {
  void* library = dlopen(soname, RTLD_NOW | RTLD_LOCAL);
  if (library) return library;
  const char* reason = dlerror();
  throw MachineError(std::string("GL: cannot open ") + soname + " (Debian package " +
                     debian_package + "): " + (reason ? reason : "no reason given"));
}

void* find_symbol(void* library, const char* soname, const char* name) {
  void* symbol = dlsym(library, name);
  if (!symbol) throw MachineError(std::string("GL: ") + soname + " has no function " + name);
  return symbol;
}

GlContext::GlContext(GlEngine engine)
    : engine_(engine),
      backend_(engine == GlEngine::kOsmesa ? make_osmesa_backend() : make_egl_backend()) {
  const GlLoader loader = backend_->loader();
  require_version(loader);
  gl_ = load_gl(loader);
  renderer_ = gl_string(gl_, GL_RENDERER);
  version_ = gl_string(gl_, GL_VERSION);
  n_threads_ = count_raster_threads(renderer_);
  set_house_state(gl_);
  check_gl(gl_, "setting up the context");
}

bool is_software_renderer(const Gl& gl) {
  const auto* renderer = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
  return renderer && count_raster_threads(renderer) > 0;
}

}  // namespace viewcell
