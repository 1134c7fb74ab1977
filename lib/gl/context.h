// An offscreen OpenGL 4.5 core context, from OSMesa or from EGL without a surface.
//
// The library asked for is opened at run time and neither is linked: a machine needs only the one
// it uses, and the two can be compared in one process. Mesa dropped OSMesa in 25.1.
#pragma once

#include <memory>
#include <string>

#include "gl/gl.h"

namespace viewcell {

enum class GlEngine { kOsmesa, kEgl };

/// "osmesa" or "egl". Throws UsageError for anything else.
GlEngine parse_gl_engine(const std::string& name);

/// How a context is had; lib/gl's own business.
class GlBackend {
 public:
  virtual ~GlBackend() = default;
  virtual void make_current() = 0;
  virtual GlLoader loader() const = 0;
};

/// True of a driver known to draw on the processor's cores (Mesa's llvmpipe and softpipe).
bool is_software_renderer(const Gl& gl);

/// Owns a context, which is current on the thread that made it. Draw into a GlFramebuffer: the
/// default framebuffer is a dummy or absent.
///
/// State set once, which every drawer may rely on and must leave: clip depth in [0, 1] from the
/// lower left, depth test on with GL_GREATER and clear depth 0 (reversed: nearer is greater),
/// counter-clockwise front faces, culling of back faces on, no dithering, rows packed to bytes.
class GlContext {
 public:
  /// Throws MachineError when the library, a display or GL 4.5 core is missing.
  explicit GlContext(GlEngine engine);

  const Gl& gl() const { return gl_; }
  GlEngine engine() const { return engine_; }
  /// GL_RENDERER, for example "llvmpipe (LLVM 15.0.6, 256 bits)".
  const std::string& renderer() const { return renderer_; }
  const std::string& gl_version() const { return version_; }
  /// Raster threads of a software renderer; 0 when the renderer is not one.
  int n_threads() const { return n_threads_; }
  /// Moves the context to the calling thread.
  void make_current() { backend_->make_current(); }

 private:
  GlEngine engine_;
  std::unique_ptr<GlBackend> backend_;
  Gl gl_;
  std::string renderer_;
  std::string version_;
  int n_threads_ = 0;
};

}  // namespace viewcell
