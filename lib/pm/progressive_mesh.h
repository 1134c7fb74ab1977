// Progressive meshes: a base mesh and the vertex splits that lead from it to the input
// [Hoppe 1996].
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/used_vertices.h"

namespace viewcell {

/// One vertex split, which undoes the collapse child -> parent. Its lists lie one after another in
/// the record's arrays. Where child and parent are the same vertex, a piece that had vanished comes
/// back whole: faces with it and with others that are at no face before; nothing moves.
struct VertexSplit {
  std::uint32_t child = 0, parent = 0;  ///< vertices
  std::uint32_t n_born = 0;             ///< faces that come back
  std::uint32_t n_moved = 0;            ///< corners that go from the parent's wedges to the child's
  std::uint32_t n_pairs = 0;            ///< wedges of the child, each with the parent's that had it
  float cost = 0;                       ///< the metric's, of the collapse
  /// After the collapse no point of mesh or input is farther than this from the other surface;
  /// below 0: not known.
  float error = -1;

  bool is_piece() const { return child == parent; }
};
static_assert(sizeof(VertexSplit) == 28);

/// A progressive mesh at its coarsest, as its file has it. Vertices, faces and their numbers are
/// the input's. Wedge w < positions.size() is what is drawn at vertex w of the input; further
/// wedges are further texture coordinates, materials or normals of one (extra_sources).
struct ProgressiveRecord {
  TriMesh
      attributes;  ///< positions, normals, colours of the input; materials of faces; no triangles
  std::vector<std::uint32_t> vertex_of;      ///< the vertex that an input vertex is welded to
  std::vector<std::uint32_t> extra_sources;  ///< of wedges from positions.size() on: input vertex
  std::vector<glm::vec2> texcoords;          ///< of wedges; empty without
  std::vector<glm::vec3> wedge_normals;      ///< unit; empty where the input has none by corner
  std::vector<Triangle> faces;      ///< three wedges each: in the base, or when the face comes back
  std::vector<VertexSplit> splits;  ///< coarse to fine
  std::vector<std::uint32_t> born;  ///< faces
  std::vector<std::uint32_t> moved;    ///< corners, 3 * face + k
  std::vector<std::uint8_t> moved_by;  ///< of each moved corner: index of its pair in the split's
  struct WedgePair {
    std::uint32_t child, parent;
  };
  std::vector<WedgePair> pairs;
  /// What a full-edge collapse overwrote: the parent's position, one a split, and the texture
  /// coordinates of each pair's parent. Empty for half-edge collapses.
  std::vector<glm::vec3> parent_positions;
  std::vector<glm::vec2> parent_texcoords;
  std::string made_by;  ///< JSON: tool, version, options, hash of the input

  bool is_full_edge() const { return !parent_positions.empty(); }
};

/// A progressive mesh at some level; refining and coarsening take time in proportion to the faces
/// that come and go.
class ProgressiveMesh {
 public:
  /// At the base. The record must be sound (see check_record).
  explicit ProgressiveMesh(ProgressiveRecord record);

  std::size_t n_faces() const { return n_faces_; }
  std::size_t n_base_faces() const { return n_base_faces_; }
  std::size_t n_splits() const { return record_.splits.size(); }
  /// Pieces of the input that have vanished whole from this level.
  std::size_t n_vanished() const;
  /// Calls visit(face) for their faces, which the record has as they were when they vanished.
  template <typename Visit>
  void for_each_vanished_face(Visit&& visit) const {
    std::size_t born = at_born_;
    for (std::size_t i = level_; i < n_splits(); born += record_.splits[i].n_born, ++i)
      for (std::size_t k = 0; k < record_.splits[i].n_born && record_.splits[i].is_piece(); ++k)
        visit(record_.born[born + k]);
  }
  /// Index into the record's pairs of the first of split level(), the next that refine() makes; the
  /// same of born.
  std::size_t first_pair() const { return at_pair_; }
  std::size_t first_born() const { return at_born_; }
  bool has_face(std::size_t face) const { return is_alive_[face]; }
  /// Splits made so far: 0 at the base, n_splits() at the input.
  std::size_t level() const { return level_; }
  /// The cost of the collapse that made this level from the next finer one; 0 at the input.
  float cost() const;
  /// A bound on the distance of this level and the input, both ways; 0 at the input, below 0 when
  /// it is not known.
  float error() const;

  /// Its faces, positions and texture coordinates are those of this level.
  const ProgressiveRecord& record() const { return record_; }

  void refine();   ///< level() < n_splits()
  void coarsen();  ///< level() > 0
  /// The finest level of at most n faces, or the base.
  void set_faces(std::size_t n);
  /// The coarsest level whose error() is at most `most`, mesh units. Returns false, and stays,
  /// where a level's error is not known.
  bool set_error(double most);
  void set_level(std::size_t level);

  /// The mesh at this level: vertices and faces in the input's order, those of the input that are
  /// used (at the input: all). source_vertex: their numbers in the input, if wanted. Welded
  /// vertices are all where the first of them is, but at the input. Normals are the input's, by
  /// vertex or corner; after full-edge collapses computed, by corner where creases may be.
  TriMesh extract(std::vector<std::uint32_t>* source_vertex = nullptr) const;

 private:
  std::uint32_t source_of(std::uint32_t wedge) const;
  void add_normals(const UsedVertices& used, std::span<const Triangle> wedges, TriMesh& out) const;
  void swap_stash(const VertexSplit& split, std::size_t first_pair, bool is_split);

  ProgressiveRecord record_;
  std::vector<bool> is_alive_;  // by face
  bool has_welded_ = false;     // vertices of the input
  std::size_t n_faces_ = 0, n_base_faces_ = 0, level_ = 0;
  std::size_t at_born_ = 0, at_moved_ = 0, at_pair_ = 0;  // of the next split
};

/// Splits that bring whole pieces back: the pieces that are missing in the base.
std::size_t count_vanishing_pieces(const ProgressiveRecord& record);

/// A progressive mesh at the input, with all splits made.
ProgressiveMesh make_finest(const ProgressiveRecord& record);

/// Moves texture coordinates at all levels by what is given for each face of the input. Faces that
/// share texture coordinates at a vertex must be moved alike; (0, 0) says nothing.
void move_texcoords(ProgressiveRecord& record, std::span<const glm::vec2> by);

/// Whether every number of the record is in range and the splits can be made one after another.
/// Returns what is wrong, or an empty string. Time and memory in proportion to the record.
std::string check_record(const ProgressiveRecord& record);

}  // namespace viewcell
