// A mesh as collapses need it when it has texture coordinates or split vertices: vertices are
// positions, wedges the attributes drawn at them [Hoppe 1998].
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "mesh/charts.h"
#include "mesh/weld.h"
#include "pm/collapse_mesh.h"

namespace viewcell {

/// A wedge is a vertex with one set of attributes (normal, colour, texture coordinates). Where
/// several vertices of the file stand at one position, or are welded, the first is the vertex and
/// the others are wedges of it only. Wedge w < n of the file's vertices has the attributes of
/// vertex w; further wedges are second, third, ... texture coordinates of one. Vertices and faces
/// may stand along a curve through space, so that neighbours lie together in memory.
struct WedgeMesh {
  LargeVector<glm::vec3> positions;
  std::vector<std::uint32_t> vertex_source;  ///< vertex -> the file's number of it
  std::vector<std::uint32_t> wedge_vertex;   ///< wedge -> vertex
  std::vector<std::uint32_t> wedge_source;   ///< wedge -> vertex of the file, for its attributes
  std::vector<glm::vec2> texcoords;          ///< of wedges; empty without
  /// Wedge -> its texture vertex: wedges of a vertex with equal texture coordinates, which may
  /// differ in normals and colours, share one, the lowest of them. Empty without.
  std::vector<std::uint32_t> texture_vertex;
  std::vector<Triangle> faces;             ///< three wedges each
  std::vector<std::uint32_t> face_source;  ///< face -> triangle of the file
  std::vector<std::uint32_t> face_index;   ///< face -> its index in the order of the file
  std::size_t n_welded = 0;                ///< vertices of the file that are not a vertex here
  BorderWeld apart;                        ///< those of them that stand elsewhere
  std::size_t n_dropped = 0;               ///< triangles with two corners at one position

  std::size_t n_wedges() const { return wedge_vertex.size(); }
  std::vector<Triangle> vertex_triangles() const;
};

struct WedgeOptions {
  bool along_curve = false;  ///< false: the order of the file
  WeldOptions weld;          ///< equal positions are welded always
};
WedgeMesh make_wedges(const TriMesh& mesh, const WedgeOptions& options = {});

/// Sets texture_vertex.
void find_texture_vertices(WedgeMesh& mesh);

/// Of its faces, connected by single corners too (ChartLink::corner). mesh must have texture
/// coordinates. In this room and in adaptations, charts are these.
Charts find_joined_charts(const WedgeMesh& mesh);

/// The wedge at every corner while the mesh collapses.
class WedgeTable {
 public:
  struct Pair {
    std::uint32_t from, to;  ///< wedges of u and of v
  };

  explicit WedgeTable(const WedgeMesh& mesh);
  std::uint32_t at(std::uint32_t corner) const { return corners_[corner]; }

  /// Of a wedge: see WedgeMesh. 0 without texture coordinates.
  std::uint32_t texture_vertex(std::uint32_t wedge) const {
    return texture_vertex_.empty() ? 0 : texture_vertex_[wedge];
  }

  /// For the collapse u -> v, which wedge of v takes over from each wedge of u: the pairs at the
  /// triangles that would die, and for further wedges those of their texture vertex. False when
  /// some texture vertex of u meets none of v's, or two: u would leave the boundary of its texture
  /// chart. Without texture coordinates there are no charts, and the first pair serves all.
  bool match(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v);
  const std::vector<Pair>& pairs() const { return pairs_; }
  /// The first pair of each texture vertex of u.
  const std::vector<Pair>& texture_pairs() const { return texture_pairs_; }
  /// How many of them, from the first on, copies of faces have no part in (FaceCopies).
  std::size_t n_sheet_pairs() const { return n_sheet_pairs_; }
  /// After match(): whether v may move as well, for each of its texture vertices is met by just one
  /// of u. Then pairs() has every wedge of v.
  bool match_both(const CollapseMesh& mesh, std::uint32_t v);
  /// Gives the moved corners the wedges of the last match, which must have been this collapse.
  void apply(const CollapseTrace& trace);

 private:
  bool add_pair(const Pair& pair);
  bool pair_rest(const CollapseMesh& mesh, std::uint32_t u);
  std::vector<std::uint32_t> texture_vertex_;
  LargeVector<std::uint32_t> corners_;
  std::vector<Pair> pairs_, texture_pairs_;
  std::size_t n_sheet_pairs_ = 0;
};

}  // namespace viewcell
