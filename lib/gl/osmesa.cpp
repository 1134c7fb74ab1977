#include <array>
#include <vector>

#include "base/error.h"
#include "gl/backends.h"

// After the core header, whose guard keeps the old <GL/gl.h> out.
#define GLAPIENTRY APIENTRY
#include <GL/osmesa.h>

namespace viewcell {
namespace {

constexpr const char* kOsmesaSoname = "libOSMesa.so.8";
// OSMesaMakeCurrent wants a real buffer; nothing is ever drawn into it.
constexpr int kDummySize = 64;

struct Osmesa {
  decltype(&OSMesaCreateContextAttribs) create_context_attribs;
  decltype(&OSMesaDestroyContext) destroy_context;
  decltype(&OSMesaMakeCurrent) make_current;
  decltype(&OSMesaGetProcAddress) get_proc_address;
};

Osmesa open_osmesa() {
  void* library = open_library(kOsmesaSoname, "libosmesa6");
  const auto find = [&]<typename Function>(Function& function, const char* name) {
    function = reinterpret_cast<Function>(find_symbol(library, kOsmesaSoname, name));
  };
  Osmesa osmesa{};
  find(osmesa.create_context_attribs, "OSMesaCreateContextAttribs");
  find(osmesa.destroy_context, "OSMesaDestroyContext");
  find(osmesa.make_current, "OSMesaMakeCurrent");
  find(osmesa.get_proc_address, "OSMesaGetProcAddress");
  return osmesa;
}

class OsmesaBackend final : public GlBackend {
 public:
  OsmesaBackend() : osmesa_(open_osmesa()), dummy_(kDummySize * kDummySize * 4) {
    const std::array attributes{OSMESA_FORMAT,
                                OSMESA_RGBA,
                                OSMESA_DEPTH_BITS,
                                0,
                                OSMESA_PROFILE,
                                OSMESA_CORE_PROFILE,
                                OSMESA_CONTEXT_MAJOR_VERSION,
                                4,
                                OSMESA_CONTEXT_MINOR_VERSION,
                                5,
                                0,
                                0};
    context_ = osmesa_.create_context_attribs(attributes.data(), nullptr);
    if (!context_) throw MachineError("GL: OSMesa gives no OpenGL 4.5 core context");
    make_current();
  }
  ~OsmesaBackend() override { osmesa_.destroy_context(context_); }
  OsmesaBackend(const OsmesaBackend&) = delete;
  OsmesaBackend& operator=(const OsmesaBackend&) = delete;

  void make_current() override {
    if (!osmesa_.make_current(context_, dummy_.data(), GL_UNSIGNED_BYTE, kDummySize, kDummySize))
      throw MachineError("GL: OSMesa cannot make its context current");
  }
  GlLoader loader() const override { return osmesa_.get_proc_address; }

 private:
  Osmesa osmesa_;
  std::vector<unsigned char> dummy_;
  OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<GlBackend> make_osmesa_backend() {
  return std::make_unique<OsmesaBackend>();
}

}  // namespace viewcell
