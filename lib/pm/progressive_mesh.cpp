#include "pm/progressive_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/buckets.h"
#include "base/error.h"
#include "mesh/used_vertices.h"

namespace viewcell {
namespace {

UsedVertices take_all_vertices(std::size_t n) {
  UsedVertices out{std::vector<std::uint32_t>(n), {}};
  std::iota(out.source.begin(), out.source.end(), 0u);
  out.new_index = out.source;
  return out;
}

// Turns all of them where most are against the input's: those of a mesh that is wound inside out.
void turn_to(std::span<const glm::vec3> inputs, std::vector<glm::vec3>& normals) {
  std::size_t n_against = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) n_against += glm::dot(inputs[i], normals[i]) < 0;
  if (2 * n_against <= inputs.size()) return;
  for (glm::vec3& normal : normals) normal = -normal;
}

// A corner as it is drawn.
struct DrawnCorner {
  std::uint32_t index = 0;
  double angle = 0;
  glm::dvec3 face_normal{0};  // unit
  glm::vec3 normal{0};        // the input's, of its wedge
};

// Normals by corner, weighted by angle, of the faces around its vertex that had the same normal
// there in the input, and do not turn away by more than 60 degrees: full-edge collapses join the
// wedges of a crease. vertex_of, normal_of: of corners.
template <typename VertexOf, typename NormalOf>
std::vector<glm::vec3> compute_drawn_normals(const TriMesh& mesh, std::size_t n_vertices,
                                             VertexOf&& vertex_of, NormalOf&& normal_of) {
  constexpr double kCreaseCosine = 0.5;
  constexpr float kSameCosine = 0.999f;
  constexpr std::size_t kManyCorners = 256;  // of a vertex: all are averaged
  const std::size_t n = 3 * mesh.triangles.size();
  const auto corners = fill_buckets<DrawnCorner>(n_vertices, [&](const auto& emit) {
    for (std::uint32_t c = 0; c < n; ++c) {
      const Triangle& t = mesh.triangles[c / 3];
      const glm::dvec3 at(mesh.positions[t[c % 3]]), normal = area_normal(mesh, t);
      const glm::dvec3 a = glm::dvec3(mesh.positions[t[(c + 1) % 3]]) - at;
      const glm::dvec3 b = glm::dvec3(mesh.positions[t[(c + 2) % 3]]) - at;
      const double length = glm::length(normal);
      DrawnCorner corner{c, 0, {}, normal_of(c)};
      if (length > 0)
        corner.angle = std::atan2(length, glm::dot(a, b)), corner.face_normal = normal / length;
      emit(vertex_of(c), corner);
    }
  });
  std::vector<glm::vec3> out(n, glm::vec3(0, 0, 1));
  for (std::size_t v = 0; v < n_vertices; ++v) {
    const auto around = corners.of(v);
    const auto are_smooth = [&](const DrawnCorner& a, const DrawnCorner& b) {
      return around.size() > kManyCorners ||
             (glm::dot(a.face_normal, b.face_normal) > kCreaseCosine &&
              glm::dot(a.normal, b.normal) > kSameCosine);
    };
    for (const DrawnCorner& corner : around) {
      glm::dvec3 sum(0);
      for (const DrawnCorner& other : around)
        if (are_smooth(corner, other)) sum += other.angle * other.face_normal;
      const double length = glm::length(sum);
      if (length > 0) out[corner.index] = glm::vec3(sum / length);
    }
  }
  std::vector<glm::vec3> inputs;
  for (std::uint32_t c = 0; c < n; ++c) inputs.push_back(normal_of(c));
  turn_to(inputs, out);
  return out;
}

std::size_t count_whole_pieces(std::span<const VertexSplit> splits) {
  return static_cast<std::size_t>(std::count_if(
      splits.begin(), splits.end(), [](const VertexSplit& split) { return split.is_piece(); }));
}

}  // namespace

ProgressiveMesh::ProgressiveMesh(ProgressiveRecord record)
    : record_(std::move(record)), is_alive_(record_.faces.size(), true) {
  for (const std::uint32_t face : record_.born) is_alive_[face] = false;
  for (std::uint32_t v = 0; v < record_.vertex_of.size(); ++v)
    has_welded_ = has_welded_ || record_.vertex_of[v] != v;
  n_base_faces_ = n_faces_ = record_.faces.size() - record_.born.size();
}

float ProgressiveMesh::cost() const {
  return level_ < n_splits() ? record_.splits[level_].cost : 0;
}

float ProgressiveMesh::error() const {
  return level_ < n_splits() ? record_.splits[level_].error : 0;
}

// The parent as before and as after the collapse are swapped with the record. A wedge of the
// parent in several pairs was stashed as they follow each other, so splits go against their order.
void ProgressiveMesh::swap_stash(const VertexSplit& split, std::size_t first_pair, bool is_split) {
  if (!record_.is_full_edge()) return;
  std::swap(record_.attributes.positions[split.parent], record_.parent_positions[level_]);
  if (record_.texcoords.empty()) return;
  for (std::size_t k = 0; k < split.n_pairs; ++k) {
    const std::size_t i = first_pair + (is_split ? split.n_pairs - 1 - k : k);
    std::swap(record_.texcoords[record_.pairs[i].parent], record_.parent_texcoords[i]);
  }
}

void ProgressiveMesh::refine() {
  VIEWCELL_CHECK(level_ < n_splits(), level_);
  const VertexSplit& split = record_.splits[level_];
  for (std::size_t i = at_moved_; i < at_moved_ + split.n_moved; ++i) {
    const std::uint32_t corner = record_.moved[i];
    record_.faces[corner / 3][corner % 3] = record_.pairs[at_pair_ + record_.moved_by[i]].child;
  }
  for (std::size_t i = at_born_; i < at_born_ + split.n_born; ++i)
    is_alive_[record_.born[i]] = true;
  swap_stash(split, at_pair_, true);
  at_moved_ += split.n_moved, at_born_ += split.n_born, at_pair_ += split.n_pairs;
  n_faces_ += split.n_born;
  ++level_;
}

void ProgressiveMesh::coarsen() {
  VIEWCELL_CHECK(level_ > 0);
  --level_;
  const VertexSplit& split = record_.splits[level_];
  at_moved_ -= split.n_moved, at_born_ -= split.n_born, at_pair_ -= split.n_pairs;
  n_faces_ -= split.n_born;
  for (std::size_t i = at_moved_; i < at_moved_ + split.n_moved; ++i) {
    const std::uint32_t corner = record_.moved[i];
    record_.faces[corner / 3][corner % 3] = record_.pairs[at_pair_ + record_.moved_by[i]].parent;
  }
  for (std::size_t i = at_born_; i < at_born_ + split.n_born; ++i)
    is_alive_[record_.born[i]] = false;
  swap_stash(split, at_pair_, false);
}

std::size_t ProgressiveMesh::n_vanished() const {
  return count_whole_pieces(std::span(record_.splits).subspan(level_));
}

void ProgressiveMesh::set_faces(std::size_t n) {
  while (n_faces_ > n && level_ > 0) coarsen();
  while (level_ < n_splits() && n_faces_ + record_.splits[level_].n_born <= n) refine();
}

bool ProgressiveMesh::set_error(double most) {
  const std::vector<VertexSplit>& splits = record_.splits;
  if (std::any_of(splits.begin(), splits.end(), [](const VertexSplit& s) { return s.error < 0; }))
    return false;
  std::size_t level = 0;
  while (level < splits.size() && !(splits[level].error <= most)) ++level;
  set_level(level);
  return true;
}

void ProgressiveMesh::set_level(std::size_t level) {
  VIEWCELL_CHECK(level <= n_splits(), level, n_splits());
  while (level_ > level) coarsen();
  while (level_ < level) refine();
}

std::uint32_t ProgressiveMesh::source_of(std::uint32_t wedge) const {
  const std::size_t n = record_.attributes.positions.size();
  return wedge < n ? wedge : record_.extra_sources[wedge - n];
}

// Of a mesh that has all but them; wedges: of its triangles.
void ProgressiveMesh::add_normals(const UsedVertices& used, std::span<const Triangle> wedges,
                                  TriMesh& out) const {
  const std::vector<glm::vec3>& of_vertices = record_.attributes.normals;
  const std::vector<glm::vec3>& of_wedges = record_.wedge_normals;
  const bool has_moved = record_.is_full_edge() && level_ < n_splits();
  if (!has_moved) {
    out.normals = used.pick(of_vertices);
    if (!of_wedges.empty())
      for (const Triangle& face : wedges)
        for (const std::uint32_t w : face) out.corner_normals.push_back(of_wedges[w]);
    return;
  }
  if (of_vertices.empty() && of_wedges.empty()) return;
  if (of_wedges.empty() && !has_welded_) {
    out.normals = make_vertex_normals(out);
    turn_to(used.pick(of_vertices), out.normals);
    return;
  }
  out.corner_normals = compute_drawn_normals(
      out, record_.vertex_of.size(),
      [&](std::uint32_t c) { return record_.vertex_of[source_of(wedges[c / 3][c % 3])]; },
      [&](std::uint32_t c) {
        const std::uint32_t w = wedges[c / 3][c % 3];
        return of_wedges.empty() ? of_vertices[source_of(w)] : of_wedges[w];
      });
}

TriMesh ProgressiveMesh::extract(std::vector<std::uint32_t>* source_vertex) const {
  const TriMesh& from = record_.attributes;
  const bool is_input = level_ == n_splits();
  TriMesh out;
  out.material_names = from.material_names;
  out.material_libraries = from.material_libraries;
  out.offset = from.offset;
  std::vector<Triangle> wedges;
  for (std::size_t f = 0; f < record_.faces.size(); ++f) {
    if (!is_alive_[f]) continue;
    const Triangle& face = record_.faces[f];
    wedges.push_back(face);
    out.triangles.push_back({source_of(face[0]), source_of(face[1]), source_of(face[2])});
    if (!record_.texcoords.empty())
      for (const std::uint32_t wedge : face) out.texcoords.push_back(record_.texcoords[wedge]);
    if (!from.materials.empty()) out.materials.push_back(from.materials[f]);
  }
  UsedVertices used = is_input ? take_all_vertices(from.positions.size())
                               : find_used_vertices(out.triangles, from.positions.size());
  out.triangles = used.renumber(out.triangles);
  for (const std::uint32_t v : used.source)
    out.positions.push_back(from.positions[is_input ? v : record_.vertex_of[v]]);
  out.colors = used.pick(from.colors);
  add_normals(used, wedges, out);
  if (source_vertex) *source_vertex = std::move(used.source);
  return out;
}

namespace {

std::string check_counts(const ProgressiveRecord& r, std::size_t n_wedges) {
  std::uint64_t n_born = 0, n_moved = 0, n_pairs = 0;
  for (const VertexSplit& split : r.splits)
    n_born += split.n_born, n_moved += split.n_moved, n_pairs += split.n_pairs;
  const TriMesh& a = r.attributes;
  const auto fits = [](std::size_t size, std::size_t n) { return size == 0 || size == n; };
  if (n_born != r.born.size() || n_moved != r.moved.size() || n_pairs != r.pairs.size())
    return "the splits' counts are not those of their lists";
  if (r.moved_by.size() != r.moved.size() || r.vertex_of.size() != a.positions.size() ||
      !fits(a.normals.size(), a.positions.size()) || !fits(a.colors.size(), a.positions.size()) ||
      !fits(a.materials.size(), r.faces.size()) || !fits(r.texcoords.size(), n_wedges) ||
      !fits(r.wedge_normals.size(), n_wedges) || !fits(r.parent_positions.size(), r.splits.size()))
    return "an attribute has not one value an element";
  const bool stashes_texcoords = r.is_full_edge() && !r.texcoords.empty();
  if (r.parent_texcoords.size() != (stashes_texcoords ? r.pairs.size() : 0))
    return "the parents' texture coordinates are not one a pair";
  return "";
}

std::string check_ranges(const ProgressiveRecord& r, std::size_t n_wedges) {
  const std::size_t n = r.attributes.positions.size();
  for (const std::uint32_t v : r.extra_sources)
    if (v >= n) return "a wedge's vertex is out of range";
  for (std::size_t v = 0; v < n; ++v)
    if (r.vertex_of[v] >= n || r.vertex_of[r.vertex_of[v]] != r.vertex_of[v])
      return "vertex " + std::to_string(v) + " is welded to none";
  const auto vertex_of = [&](std::uint32_t w) {
    return r.vertex_of[w < n ? w : r.extra_sources[w - n]];
  };
  for (const Triangle& face : r.faces) {
    for (const std::uint32_t w : face)
      if (w >= n_wedges) return "a face's wedge is out of range";
    const auto a = vertex_of(face[0]), b = vertex_of(face[1]), c = vertex_of(face[2]);
    if (a == b || b == c || c == a) return "a face has two corners at one vertex";
  }
  for (const std::int32_t m : r.attributes.materials)
    if (m < 0 || static_cast<std::size_t>(m) >= r.attributes.material_names.size())
      return "a face's material is out of range";
  for (const auto& pair : r.pairs)
    if (pair.child >= n_wedges || pair.parent >= n_wedges) return "a pair's wedge is out of range";
  return "";
}

// Makes the splits one after another and checks that each is the inverse of an edge collapse, since
// logs of adaptations replay the collapses: every face at the child is born or moved by the split,
// and exactly the born ones have the edge; or that it brings faces with vertices that no other face
// has.
class SplitChecker {
 public:
  explicit SplitChecker(const ProgressiveRecord& r)
      : r_(r),
        faces_(r.faces),
        is_alive_(r.faces.size(), true),
        n_corners_(r.attributes.positions.size(), 0) {}

  std::string check_base();
  /// Of the next split.
  std::string check(const VertexSplit& split);

 private:
  std::uint32_t vertex_of(std::uint32_t wedge) const {
    const std::size_t n = r_.vertex_of.size();
    return r_.vertex_of[wedge < n ? wedge : r_.extra_sources[wedge - n]];
  }
  // Corners of a face at a vertex.
  std::ptrdiff_t count(const Triangle& face, std::uint32_t vertex) const {
    return std::count_if(face.begin(), face.end(),
                         [&](std::uint32_t wedge) { return vertex_of(wedge) == vertex; });
  }
  std::string check_pairs(const VertexSplit& split) const;
  std::string move_corners(const VertexSplit& split);
  std::string bear_faces(const VertexSplit& split);
  std::string bear_piece(const VertexSplit& split);
  void bear(std::uint32_t face);

  const ProgressiveRecord& r_;
  std::vector<Triangle> faces_;
  std::vector<bool> is_alive_;
  std::vector<std::uint32_t> n_corners_;  // by vertex, of faces that are there
  std::size_t born_ = 0, moved_ = 0, pair_ = 0;
};

std::string SplitChecker::check_base() {
  for (const std::uint32_t face : r_.born) {
    if (face >= faces_.size() || !is_alive_[face]) return "a face comes twice, or is none";
    is_alive_[face] = false;
  }
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (const std::uint32_t wedge : faces_[f]) n_corners_[vertex_of(wedge)] += is_alive_[f];
  return "";
}

std::string SplitChecker::check(const VertexSplit& split) {
  if (std::max(split.child, split.parent) >= n_corners_.size())
    return "names a vertex out of range";
  if (n_corners_[split.child] > 0) return "has a child that is there already";
  if (split.is_piece()) return bear_piece(split);
  std::string wrong = check_pairs(split);
  if (wrong.empty()) wrong = move_corners(split);
  if (wrong.empty()) wrong = bear_faces(split);
  pair_ += split.n_pairs;
  return wrong;
}

std::string SplitChecker::check_pairs(const VertexSplit& split) const {
  for (std::size_t i = pair_; i < pair_ + split.n_pairs; ++i) {
    const auto& pair = r_.pairs[i];
    if (vertex_of(pair.child) != split.child || vertex_of(pair.parent) != split.parent)
      return "has a pair of wedges that are not the child's and the parent's";
  }
  return "";
}

std::string SplitChecker::move_corners(const VertexSplit& split) {
  for (std::uint32_t k = 0; k < split.n_moved; ++k, ++moved_) {
    const std::uint32_t corner = r_.moved[moved_];
    if (corner / 3 >= faces_.size() || !is_alive_[corner / 3] ||
        r_.moved_by[moved_] >= split.n_pairs)
      return "moves a corner that is not there";
    Triangle& face = faces_[corner / 3];
    const auto& by = r_.pairs[pair_ + r_.moved_by[moved_]];
    if (face[corner % 3] != by.parent) return "moves a corner that is not the parent's";
    face[corner % 3] = by.child;
    if (count(face, split.child) != 1 || count(face, split.parent) != 0)
      return "moves a corner of a face that has the edge";
    ++n_corners_[split.child], --n_corners_[split.parent];
  }
  return "";
}

std::string SplitChecker::bear_faces(const VertexSplit& split) {
  for (std::uint32_t k = 0; k < split.n_born; ++k, ++born_) {
    const std::uint32_t f = r_.born[born_];
    if (count(faces_[f], split.child) != 1 || count(faces_[f], split.parent) != 1)
      return "brings a face that has not the edge";
    bear(f);
  }
  return "";
}

void SplitChecker::bear(std::uint32_t face) {
  is_alive_[face] = true;
  for (const std::uint32_t wedge : faces_[face]) ++n_corners_[vertex_of(wedge)];
}

std::string SplitChecker::bear_piece(const VertexSplit& split) {
  if (split.n_moved > 0 || split.n_pairs > 0) return "brings a piece and moves others";
  const std::size_t first = born_;
  std::ptrdiff_t n_at_vertex = 0;
  for (born_ = first; born_ < first + split.n_born; ++born_) {
    const Triangle& face = faces_[r_.born[born_]];
    n_at_vertex += count(face, split.child);
    for (const std::uint32_t wedge : face)
      if (n_corners_[vertex_of(wedge)] > 0 || count(face, vertex_of(wedge)) != 1)
        return "brings a piece that joins what is there, or a face without an area";
  }
  if (n_at_vertex == 0) return "brings a piece without its vertex";
  for (std::size_t i = first; i < born_; ++i) bear(r_.born[i]);
  return "";
}

std::string check_splits(const ProgressiveRecord& r) {
  SplitChecker checker(r);
  if (std::string wrong = checker.check_base(); !wrong.empty()) return wrong;
  for (std::size_t i = 0; i < r.splits.size(); ++i)
    if (const std::string wrong = checker.check(r.splits[i]); !wrong.empty())
      return "split " + std::to_string(i) + " " + wrong;
  return "";
}

}  // namespace

std::size_t count_vanishing_pieces(const ProgressiveRecord& record) {
  return count_whole_pieces(record.splits);
}

ProgressiveMesh make_finest(const ProgressiveRecord& record) {
  ProgressiveMesh mesh(record);
  mesh.set_level(mesh.n_splits());
  return mesh;
}

// All wedges are drawn by some face of the input; a coarser level has no others.
void move_texcoords(ProgressiveRecord& record, std::span<const glm::vec2> by) {
  const ProgressiveMesh finest = make_finest(record);
  VIEWCELL_CHECK(by.size() == finest.record().faces.size(), by.size());
  std::vector<glm::vec2> of_wedges(record.texcoords.size(), glm::vec2(0));
  for (std::size_t f = 0; f < by.size(); ++f)
    for (const std::uint32_t wedge : finest.record().faces[f])
      if (by[f] != glm::vec2(0)) of_wedges[wedge] = by[f];
  for (std::size_t w = 0; w < of_wedges.size(); ++w) record.texcoords[w] += of_wedges[w];
  for (std::size_t i = 0; i < record.parent_texcoords.size(); ++i)
    record.parent_texcoords[i] += of_wedges[record.pairs[i].parent];
}

std::string check_record(const ProgressiveRecord& record) {
  const std::size_t n_wedges = record.attributes.positions.size() + record.extra_sources.size();
  for (const auto& check : {check_counts, check_ranges})
    if (std::string wrong = check(record, n_wedges); !wrong.empty()) return wrong;
  return check_splits(record);
}

}  // namespace viewcell
