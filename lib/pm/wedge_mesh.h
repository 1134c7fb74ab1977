// A mesh as collapses need it when it has texture coordinates or split vertices: vertices are
// positions, wedges the attributes drawn at them [Hoppe 1998].
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "mesh/charts.h"
#include "mesh/weld.h"
#include "pm/collapse_mesh.h"

namespace viewcell {

inline constexpr std::uint32_t kNoWedge = 0xffffffffu;

/// A wedge is a vertex with one set of attributes (normal, colour, texture coordinates, material of
/// its faces). Where several vertices of the file stand at one position, or are welded, the first
/// is the vertex and the others are wedges of it only. Wedge w < n of the file's vertices has the
/// attributes of vertex w; further wedges are second, third, ... texture coordinates, materials or
/// normals of one. Vertices and faces
/// may stand along a curve through space, so that neighbours lie together in memory.
struct WedgeMesh {
  LargeVector<glm::vec3> positions;
  std::vector<std::uint32_t> vertex_source;  ///< vertex -> the file's number of it
  std::vector<std::uint32_t> wedge_vertex;   ///< wedge -> vertex
  std::vector<std::uint32_t> wedge_source;   ///< wedge -> vertex of the file, for its attributes
  std::vector<glm::vec2> texcoords;          ///< of wedges; empty without
  std::vector<glm::vec3> normals;            ///< of wedges, unit; empty where none has two
  /// Wedge -> its texture vertex: wedges of a vertex with equal texture coordinates, which may
  /// differ in all else, share one, the lowest of them. Empty without.
  std::vector<std::uint32_t> texture_vertex;
  /// Wedge -> its chart vertex: likewise of those that are equal in material and colour, too, in
  /// all but normals. Empty where no material and no colour meets another: see chart().
  std::vector<std::uint32_t> chart_vertex;
  std::vector<Triangle> faces;             ///< three wedges each
  std::vector<std::uint32_t> face_source;  ///< face -> triangle of the file
  std::vector<std::uint32_t> face_index;   ///< face -> its index in the order of the file
  std::size_t n_welded = 0;                ///< vertices of the file that are not a vertex here
  BorderWeld apart;                        ///< those of them that stand elsewhere
  std::size_t n_dropped = 0;               ///< triangles with two corners at one position

  /// Likewise of those that are equal in material and colour, whatever else. Empty with
  /// chart_vertex.
  std::vector<std::uint32_t> region_vertex;

  std::size_t n_wedges() const { return wedge_vertex.size(); }
  std::vector<Triangle> vertex_triangles() const;
  /// The chart vertex of a wedge, or its texture vertex; 0 without charts.
  std::uint32_t chart(std::uint32_t wedge) const {
    if (!chart_vertex.empty()) return chart_vertex[wedge];
    return texture_vertex.empty() ? 0 : texture_vertex[wedge];
  }
};

struct WedgeOptions {
  bool along_curve = false;  ///< false: the order of the file
  WeldOptions weld;          ///< equal positions are welded always
  /// Where materials meet, or colours at one position, are borders, as those of texture charts.
  bool materials = true, colours = true;
};
WedgeMesh make_wedges(const TriMesh& mesh, const WedgeOptions& options = {});

/// Sets texture_vertex.
void find_texture_vertices(WedgeMesh& mesh);

/// Of its faces in the texture, connected by single corners too (ChartLink::corner). mesh must have
/// texture coordinates. In this room and in adaptations, charts are these.
Charts find_joined_charts(const WedgeMesh& mesh);

/// The wedge at every corner while the mesh collapses.
class WedgeTable {
 public:
  struct Pair {
    std::uint32_t from, to;  ///< wedges of u and of v
    bool operator==(const Pair&) const = default;
  };

  explicit WedgeTable(const WedgeMesh& mesh);
  std::uint32_t at(std::uint32_t corner) const { return corners_[corner]; }

  bool has_charts() const { return !chart_vertex_.empty(); }
  /// Whether charts end where materials or colours meet, too.
  bool has_regions() const { return has_regions_; }
  /// Of a wedge: see WedgeMesh::chart. 0 without charts.
  std::uint32_t chart_vertex(std::uint32_t wedge) const {
    return chart_vertex_.empty() ? 0 : chart_vertex_[wedge];
  }

  /// For the collapse u -> v, which wedge of v takes over from each wedge of u: the pairs at the
  /// triangles that would die, and for further wedges those of their chart vertex. False when some
  /// chart vertex of u meets none of v's, or two: u would leave the boundary of its chart. Without
  /// charts the first pair serves all.
  bool match(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v);
  const std::vector<Pair>& pairs() const { return pairs_; }
  /// The first pair of each chart vertex of u.
  const std::vector<Pair>& chart_pairs() const { return chart_pairs_; }
  /// How many of them, from the first on, copies of faces have no part in (FaceCopies).
  std::size_t n_sheet_pairs() const { return n_sheet_pairs_; }
  /// After match(): whether v may move as well, for each of its chart vertices is met by just one
  /// of u. Then pairs() has every wedge of v.
  bool match_both(const CollapseMesh& mesh, std::uint32_t v);
  /// After match(): further wedges of u go to the wedge of v in their chart whose normal is
  /// nearest.
  void choose_by_normals(const CollapseMesh& mesh, std::uint32_t v);
  /// A wedge of v in each of its charts, those of copies too. Valid until it is asked for another.
  const std::vector<std::uint32_t>& chart_wedges(const CollapseMesh& mesh, std::uint32_t v);
  /// Gives the moved corners the wedges of the last match, which must have been this collapse.
  void apply(const CollapseTrace& trace);

 private:
  struct Spoke {  // a triangle (u, a, b)
    std::uint32_t wedge_u, a, b, wedge_a, wedge_b;
  };
  // What was gone through last, of one vertex while the mesh is what it was: costs are asked for
  // one u and many v, or for one v and many u.
  struct Gathered {
    std::uint32_t of = kNoVertex;
    std::size_t n_triangles = 0;  // of the mesh: each change takes some
    bool is(std::uint32_t v, const CollapseMesh& mesh) const {
      return of == v && n_triangles == mesh.n_triangles();
    }
  };
  static constexpr std::uint32_t kNoVertex = 0xffffffffu;

  void gather_from(const CollapseMesh& mesh, std::uint32_t u);
  void gather_to(const CollapseMesh& mesh, std::uint32_t v);
  bool find_pairs(std::uint32_t v);
  bool pair_up(std::span<const Spoke> spokes, std::uint32_t v);
  bool add_pair(const Pair& pair);
  bool pair_rest();
  bool keeps_texture(const Pair& pair) const;
  std::uint32_t find_nearest(const CollapseMesh& mesh, std::uint32_t v, const Pair& pair) const;
  std::vector<std::uint32_t> chart_vertex_, texture_vertex_;  // the latter if charts are finer
  std::vector<glm::vec3> normals_;                            // of wedges; or empty
  bool has_regions_ = false;
  LargeVector<std::uint32_t> corners_;
  std::vector<Pair> pairs_, chart_pairs_;
  std::size_t n_sheet_pairs_ = 0, first_further_ = 0, end_further_ = 0;  // of pairs_
  Gathered from_, to_;
  std::vector<Spoke> spokes_;  // of from_; those of copies behind n_sheet_spokes_
  std::size_t n_sheet_spokes_ = 0;
  std::vector<std::uint32_t> from_wedges_, to_wedges_;  // each once
  std::vector<std::uint32_t> chart_wedges_;             // of to_, one a chart
  // The last match, while from_ is what it was matched from.
  std::uint32_t matched_to_ = kNoVertex;
  std::size_t n_matched_ = 0;  // of pairs_
  bool fits_ = false;
};

}  // namespace viewcell
