// Which cells and centres are in GL memory: loading ahead, uploading within a budget, evicting.
#pragma once

#include <map>
#include <optional>

#include "play/hybrid_plan.h"
#include "play/loader.h"
#include "play/stand_in.h"
#include "play/texel_pool.h"

namespace viewcell {

struct ResidencyOptions {
  std::uint32_t pool_texels = 64u << 20;      ///< GL memory for textures, 4 bytes a texel
  std::uint32_t texels_per_frame = 1u << 19;  ///< uploaded ahead of need before each frame, at most
  std::size_t n_cells = 24;                   ///< cells whose geometry is kept
  bool prefetch = true;                       ///< false: everything is loaded when it is needed
};

/// Texture coordinates of one object in one view: dot(row, (p, 1)) of a cell-local point p gives
/// s q, t q and q = depth; s / q and t / q are texels of the crop.
struct ViewProjection {
  glm::vec4 row_s{0}, row_t{0}, row_q{0};
  std::int32_t first_texel = 0, width_px = 0, height_px = 0;
  float code_scale = 0, code_bias = 0;  ///< depth code in [0, 1] = scale / q + bias
  float focal_px = 0;                   ///< texels per unit tangent
  glm::vec3 eye{0};                     ///< of the view; cell-local
};

struct ResidentCell {
  std::shared_ptr<const ReadyCell> ready;  ///< null: damaged_cell
  StandIn stand_in = StandIn::none;        ///< or damaged_cell, or damaged_textures
  GlBuffer vertices, indices;
  GlVertexArray array;
  GlBuffer unseen_vertices, unseen_indices;
  GlVertexArray unseen_array;
  ViewsAvailable views;                     ///< by slot
  std::vector<ViewProjection> projections;  ///< slot * kViews + view
};

/// Follows: [Chen06 5.2.2, Prefetching scheme]: neighbours are asked for in order of urgency, what
/// has been read waits in a queue, and a bounded amount is uploaded before each frame.
class Residency {
 public:
  /// gl and bundle must outlive this. Drawing thread only.
  Residency(const Gl& gl, const Bundle& bundle, const ResidencyOptions& options = {});

  /// The cell of the camera's eye, whole: waits for what is missing. Uploads, and asks for what
  /// will be needed next. Throws InputError when the bundle does not hold the cell.
  const ResidentCell& enter(const Camera& camera);

  std::size_t texture_bytes() const { return 4 * std::size_t{pool_.n_used()}; }
  GLuint texel_texture() const { return pool_.texture(); }
  /// Files of the cells entered that could not be read, in the order met, each once.
  const std::vector<BundleFault>& faults() const { return faults_; }
  /// Cells that had to be waited for, the first included.
  std::size_t n_stalls() const { return n_stalls_; }

 private:
  struct Centre {
    std::optional<std::uint32_t> first;  // nothing: it has no texels
    std::uint32_t n_written = 0;
    CentreTextures textures;  // its texels: until all are written
    std::size_t used_at = 0;  // frame
    std::string fault = {};   // why it could not be read
    bool is_whole() const { return textures.texels.empty(); }
  };
  struct Cell {
    ResidentCell resident;
    std::size_t used_at = 0;
    std::string fault = {};
  };

  CellId cell_of(const Camera& camera) const;
  std::vector<CentreId> centres_needed(CellId cell) const;
  void take(Loaded loaded);
  void add_cell(CellId id, Loaded loaded);
  void add_centre(CentreId id, Loaded loaded);
  void note_fault(const std::string& what, StandIn stand_in);
  std::uint32_t upload_some(Centre& centre, std::uint32_t most);
  void upload_ahead();
  void bring(CellId cell);
  void project_views(CellId id, ResidentCell& cell) const;
  void request_ahead(const Camera& camera);
  bool evict_a_centre();
  void evict_cells();
  bool is_needed(CentreId centre) const;

  const Gl& gl_;
  const Bundle& bundle_;
  ResidencyOptions options_;
  TexelPool pool_;
  std::map<CellId, Cell> cells_;
  std::map<CentreId, Centre> centres_;
  std::deque<CentreId> queue_;  // centres that are not whole yet, first come first served
  CellId current_{-1};
  std::size_t frame_ = 0;
  std::size_t n_stalls_ = 0;
  std::vector<BundleFault> faults_;
  glm::dvec3 asked_eye_{1e30}, asked_forward_{0};
  Loader loader_;
};

}  // namespace viewcell
