#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstring>
#include <vector>

#include "base/error.h"
#include "gl/backends.h"

namespace viewcell {
namespace {

constexpr const char* kEglSoname = "libEGL.so.1";

struct Egl {
  decltype(&eglGetProcAddress) get_proc_address;
  decltype(&eglGetDisplay) get_display;
  decltype(&eglInitialize) initialize;
  decltype(&eglQueryString) query_string;
  decltype(&eglBindAPI) bind_api;
  decltype(&eglChooseConfig) choose_config;
  decltype(&eglCreateContext) create_context;
  decltype(&eglDestroyContext) destroy_context;
  decltype(&eglMakeCurrent) make_current;
  // Extensions: may be null.
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display;
  PFNEGLQUERYDEVICESEXTPROC query_devices;
};

Egl open_egl() {
  void* library = open_library(kEglSoname, "libegl1 libegl-mesa0");
  const auto find = [&]<typename Function>(Function& function, const char* name) {
    function = reinterpret_cast<Function>(find_symbol(library, kEglSoname, name));
  };
  Egl egl{};
  find(egl.get_proc_address, "eglGetProcAddress");
  find(egl.get_display, "eglGetDisplay");
  find(egl.initialize, "eglInitialize");
  find(egl.query_string, "eglQueryString");
  find(egl.bind_api, "eglBindAPI");
  find(egl.choose_config, "eglChooseConfig");
  find(egl.create_context, "eglCreateContext");
  find(egl.destroy_context, "eglDestroyContext");
  find(egl.make_current, "eglMakeCurrent");
  egl.get_platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      egl.get_proc_address("eglGetPlatformDisplayEXT"));
  egl.query_devices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.get_proc_address("eglQueryDevicesEXT"));
  return egl;
}

// Displays that need no window system, the likeliest first.
std::vector<EGLDisplay> list_displays(const Egl& egl) {
  std::vector<EGLDisplay> displays;
  const char* extensions = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto has = [&](const char* name) { return extensions && std::strstr(extensions, name); };
  const auto add = [&](EGLDisplay display) {
    if (display != EGL_NO_DISPLAY) displays.push_back(display);
  };
  if (egl.get_platform_display && has("EGL_MESA_platform_surfaceless"))
    add(egl.get_platform_display(EGL_PLATFORM_SURFACELESS_MESA,
                                 reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr));
  if (egl.get_platform_display && egl.query_devices && has("EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint n = 0;
    if (egl.query_devices(static_cast<EGLint>(devices.size()), devices.data(), &n))
      for (EGLint i = 0; i < n; ++i)
        add(egl.get_platform_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
  }
  add(egl.get_display(EGL_DEFAULT_DISPLAY));
  return displays;
}

// A context on one display; EGL_NO_CONTEXT when that display cannot.
EGLContext create_context(const Egl& egl, EGLDisplay display) {
  EGLint major = 0, minor = 0;
  if (!egl.initialize(display, &major, &minor)) return EGL_NO_CONTEXT;
  const char* extensions = egl.query_string(display, EGL_EXTENSIONS);
  if (!extensions || !std::strstr(extensions, "EGL_KHR_surfaceless_context")) return EGL_NO_CONTEXT;
  if (!egl.bind_api(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  // Any surface type: the default asks for windows, which a display without a screen has not.
  const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                     EGL_NONE};
  EGLConfig config = nullptr;
  EGLint n = 0;
  if (!egl.choose_config(display, wanted.data(), &config, 1, &n) || n == 0) return EGL_NO_CONTEXT;
  const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                         4,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         5,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
  return egl.create_context(display, config, EGL_NO_CONTEXT, attributes.data());
}

class EglBackend final : public GlBackend {
 public:
  EglBackend() : egl_(open_egl()) {
    for (EGLDisplay display : list_displays(egl_)) {
      display_ = display;
      context_ = create_context(egl_, display);
      if (context_ != EGL_NO_CONTEXT) break;
    }
    if (context_ == EGL_NO_CONTEXT)
      throw MachineError("GL: no EGL display gives an OpenGL 4.5 core context without a surface");
    make_current();
  }
  // The display stays initialised: it is shared by every context of the process.
  ~EglBackend() override {
    egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl_.destroy_context(display_, context_);
  }
  EglBackend(const EglBackend&) = delete;
  EglBackend& operator=(const EglBackend&) = delete;

  void make_current() override {
    if (!egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      throw MachineError("GL: EGL cannot make its context current");
  }
  GlLoader loader() const override { return egl_.get_proc_address; }

 private:
  Egl egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<GlBackend> make_egl_backend() {
  return std::make_unique<EglBackend>();
}

}  // namespace viewcell
