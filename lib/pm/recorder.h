// Turns the collapses of a loop into a progressive mesh.
#pragma once

#include <vector>

#include "pm/chart_guard.h"
#include "pm/progressive_mesh.h"
#include "pm/texture_fold.h"
#include "pm/wedge_mesh.h"

namespace viewcell {

/// Keeps what every collapse did, in the numbers of the input. To be called for each collapse in
/// this order: match(), traced(), made().
class Recorder {
 public:
  /// Keeps references. mesh.positions are the input's times `scale`, in the order of mesh; a
  /// full-edge metric moves them. input: the mesh as it was read.
  Recorder(const WedgeMesh& mesh, const TriMesh& input, float scale, bool is_full_edge);

  /// Whether u may collapse into v for what stands at their wedges, see WedgeTable::match.
  bool match(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) {
    return table_.match(mesh, u, v);
  }
  /// After match(): the texture coordinates that its pairs get. position: where both go; unused for
  /// a half-edge collapse, which keeps the parent's. A full-edge collapse interpolates between the
  /// parent's and the child's by where the position is along the edge.
  void merge(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v, const glm::vec3& position);
  /// The same for a single pair of texture vertices whose coordinates the metric has found.
  void merge(const glm::vec2& texcoord) { merged_.assign(table_.pairs().size(), texcoord); }
  /// Whether the collapse merged last turns a triangle over in the texture. moves_both: the
  /// triangles of v are looked at, too.
  bool folds(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v, bool moves_both) const {
    return !texcoords_.empty() &&
           turns_over_texture(mesh, table_, texcoords_, u, v, merged_, moves_both);
  }
  /// Whether it makes a chart grow over another.
  bool overlaps(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v, bool moves_both,
                ChartGuard& charts) {
    return charts.overlaps(mesh, table_, texcoords_, u, v, merged_, moves_both);
  }
  /// The triangles have changed; the parent has not moved yet. u = v, here and below: a piece has
  /// vanished, of which v was a vertex.
  void traced(std::uint32_t u, std::uint32_t v, const CollapseTrace& trace);
  /// The parent has moved. cost and error are in the input's units.
  void made(std::uint32_t u, std::uint32_t v, float cost, float error, const CollapseTrace& trace);
  /// The collapses backwards, as splits. Ends the recorder.
  ProgressiveRecord finish();

  /// The wedges and texture coordinates of the mesh as it is now.
  WedgeTable& table() { return table_; }
  const std::vector<glm::vec2>& texcoords() const { return texcoords_; }

 private:
  std::uint8_t pair_index(std::uint32_t wedge) const;
  glm::vec3 unscaled(std::uint32_t v, const glm::vec3& p) const;
  void move_texcoords();
  void add_attributes(ProgressiveRecord& record) const;
  void renumber();
  void add_splits(ProgressiveRecord& record);

  const WedgeMesh& mesh_;
  const TriMesh& input_;
  float scale_;
  bool is_full_;
  std::vector<bool> has_moved_;  // by vertex, for full-edge collapses
  std::vector<glm::vec2> texcoords_;
  WedgeTable table_;
  std::vector<WedgeTable::Pair> matched_;  // of the last collapse
  std::vector<glm::vec2> merged_;          // of the pairs last matched
  std::vector<std::uint32_t> moved_from_;  // wedges of the last collapse's moved corners
  // In the order of the collapses, as in ProgressiveRecord.
  std::vector<VertexSplit> splits_;
  std::vector<std::uint32_t> born_, moved_;
  std::vector<std::uint8_t> moved_by_;
  std::vector<ProgressiveRecord::WedgePair> pairs_;
  std::vector<glm::vec3> parent_positions_;
  std::vector<glm::vec2> parent_texcoords_;
};

}  // namespace viewcell
