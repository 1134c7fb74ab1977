// One mesh, with a texture or without, drawn on plain sky.
#pragma once

#include <vector>

#include "draw/mesh_views.h"
#include "gl/framebuffer.h"
#include "gl/objects.h"
#include "image/index_map.h"
#include "image/normal_code.h"
#include "scene/lighting.h"

namespace viewcell {

/// Where normals come from: the mesh (made by make_vertex_normals where it has none), that function
/// in any case, or the triangles' planes.
enum class NormalSource { mesh, computed, flat };

/// "mesh", "computed" or "flat". Throws UsageError.
NormalSource parse_normal_source(const std::string& name);
const char* name_of(NormalSource source);

struct MeshStyle {
  int size_px = 512;  ///< side of a picture
  int samples = 2;    ///< per pixel along each side; averaged as encoded values
  bool lit = true;    ///< false: the surface's colour as it is
  /// The light turns about the vertical with the eye, from the front's right: every picture shows a
  /// lit side. False: it stays with the mesh, as in a scene.
  bool light_follows = true;
  NormalSource normals = NormalSource::mesh;
  NormalMapY normal_map_y = NormalMapY::up;
  bool flip_v = false;         ///< v = 0 is the texture's top row, not the bottom one
  bool wireframe = false;      ///< edges over the surface, a pixel wide
  glm::vec3 base_color{0.5f};  ///< linear; where there is neither texture nor vertex colour
  Lighting lighting;           ///< its sky is the background
};

/// The largest size_px * samples.
inline constexpr int kMostSamplesPerSide = 8192;

/// The next so many triangles of a mesh show this texture.
struct TexturedRun {
  ImageRgba8 texture;
  std::size_t n_triangles = 0;
};

/// The textures of a mesh's triangles: none, one, or one run after another.
class MeshTextures {
 public:
  /// Of all triangles; null: none. Must outlive this.
  MeshTextures(const ImageRgba8* texture = nullptr) : one_(texture) {}
  /// Together all triangles.
  MeshTextures(const std::vector<TexturedRun>& runs) : runs_(&runs) {}

  bool empty() const { return one_ == nullptr && runs_ == nullptr; }
  /// Calls use(texture, number of triangles) in order.
  template <typename Use>
  void for_each(std::size_t n_triangles, const Use& use) const {
    if (one_ != nullptr) use(*one_, n_triangles);
    if (runs_ != nullptr)
      for (const TexturedRun& run : *runs_) use(run.texture, run.n_triangles);
  }

 private:
  const ImageRgba8* one_ = nullptr;
  const std::vector<TexturedRun>* runs_ = nullptr;
};

/// Holds the mesh in GL memory (108 bytes a triangle, 180 with a normal map). Only the thread on
/// which the context is current may use it. Relies on, and leaves, the state of GlContext.
class MeshRenderer {
 public:
  /// textures: sRGB, taken as opaque; none: the mesh's colours are drawn if it has some. Need
  /// texture coordinates. index_map: these look it up, and what it holds
  /// looks up the textures (draw/index_map_lookup.h); needs one. normal_map: linear, in tangent
  /// space (image/normal_code.h, mesh/tangents.h), over the mesh's normals; with style.lit alone.
  /// gl must outlive this; nothing else need. Throws MachineError when GL memory runs out.
  MeshRenderer(const Gl& gl, const TriMesh& mesh, const MeshFrame& frame,
               const MeshTextures& textures, const MeshStyle& style,
               const IndexMap* index_map = nullptr, const ImageRgba8* normal_map = nullptr);

  /// A view in frame space (make_views). Both sides of a triangle are drawn, the back lit as a
  /// front that faces the same way: simplified meshes are often open. Alpha is 255 where any sample
  /// of a pixel shows the mesh, else 0, with the sky's colour. The same bytes every time.
  ImageRgba8 draw(const Camera& view) const;

 private:
  const Gl& gl_;
  MeshStyle style_;
  GlFramebuffer target_;
  GlProgram program_;
  struct Run {
    GlTexture texture;
    GLsizei n_vertices;
  };
  std::vector<Run> runs_;
  GlTexture index_map_, normal_map_;
  GlBuffer vertices_, mapped_vertices_;
  GlVertexArray array_;
};

}  // namespace viewcell
