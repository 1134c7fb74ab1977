#include "pm/recorder.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "mesh/closest_on_segment.h"
#include "pm/texture_fold.h"

namespace viewcell {
namespace {

template <typename T>
std::uint32_t size32(const std::vector<T>& values) {
  return static_cast<std::uint32_t>(values.size());
}

// The groups of values in opposite order, each group as it is; count(split) is a group's size. The
// values are freed.
template <typename T, typename Count>
std::vector<T> reverse_groups(std::vector<T>& values, const std::vector<VertexSplit>& splits,
                              Count&& count) {
  std::vector<T> out;
  out.reserve(values.size());
  auto at = values.end();
  for (std::size_t i = splits.size(); i-- > 0;) {
    const auto end = at;
    at -= count(splits[i]);
    out.insert(out.end(), at, end);
  }
  values = {};
  return out;
}

}  // namespace

Recorder::Recorder(const WedgeMesh& mesh, const TriMesh& input, float scale, bool is_full_edge)
    : mesh_(mesh),
      input_(input),
      scale_(scale),
      is_full_(is_full_edge),
      has_moved_(is_full_edge ? mesh.positions.size() : 0, false),
      texcoords_(mesh.texcoords),
      table_(mesh) {
  splits_.reserve(mesh.positions.size());
}

void Recorder::merge(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v,
                     const glm::vec3& position) {
  merged_.clear();
  if (texcoords_.empty()) return;
  const double along = is_full_
                           ? closest_on_segment(glm::dvec3(position), glm::dvec3(mesh.position(v)),
                                                glm::dvec3(mesh.position(u)))
                           : 0;
  for (const auto& [child, parent] : table_.pairs())
    merged_.push_back(
        glm::vec2(glm::mix(glm::dvec2(texcoords_[parent]), glm::dvec2(texcoords_[child]), along)));
}

void Recorder::traced(std::uint32_t u, std::uint32_t v, const CollapseTrace& trace) {
  moved_from_.clear(), matched_.clear();
  for (const std::uint32_t c : trace.moved) moved_from_.push_back(table_.at(c));
  table_.apply(trace);
  if (u != v) matched_ = table_.pairs();
  if (is_full_) parent_positions_.push_back(unscaled(v, mesh_.positions[v]));
}

void Recorder::made(std::uint32_t u, std::uint32_t v, float cost, float error,
                    const CollapseTrace& trace) {
  splits_.push_back({u, v, size32(trace.died), size32(trace.moved), size32(matched_), cost, error});
  born_.insert(born_.end(), trace.died.begin(), trace.died.end());
  moved_.insert(moved_.end(), trace.moved.begin(), trace.moved.end());
  for (const std::uint32_t wedge : moved_from_) moved_by_.push_back(pair_index(wedge));
  for (const auto& [from, to] : matched_) pairs_.push_back({from, to});
  if (!is_full_) return;
  if (!texcoords_.empty()) move_texcoords();
  has_moved_[v] = has_moved_[v] || u != v;
}

std::uint8_t Recorder::pair_index(std::uint32_t wedge) const {
  const auto found = std::find_if(matched_.begin(), matched_.end(),
                                  [&](const auto& pair) { return pair.from == wedge; });
  const auto index = found - matched_.begin();
  VIEWCELL_CHECK(index < 256, index);
  return static_cast<std::uint8_t>(index);
}

// A position in the input's units, to the bit where it is the input's.
glm::vec3 Recorder::unscaled(std::uint32_t v, const glm::vec3& p) const {
  return has_moved_[v] ? p / scale_ : input_.positions[mesh_.vertex_source[v]];
}

void Recorder::move_texcoords() {
  for (std::size_t i = 0; i < matched_.size(); ++i) {
    parent_texcoords_.push_back(texcoords_[matched_[i].to]);
    texcoords_[matched_[i].to] = merged_[i];
  }
}

void Recorder::add_attributes(ProgressiveRecord& r) const {
  TriMesh& to = r.attributes;
  to.positions = input_.positions;
  to.normals = input_.normals;
  to.colors = input_.colors;
  to.material_names = input_.material_names;
  to.material_libraries = input_.material_libraries;
  to.offset = input_.offset;
  if (is_full_)
    for (std::uint32_t v = 0; v < mesh_.positions.size(); ++v)
      to.positions[mesh_.vertex_source[v]] = unscaled(v, mesh_.positions[v]);
  const std::size_t n = input_.positions.size();
  for (std::size_t w = 0; w < mesh_.n_wedges(); ++w) {
    if (w < n)
      r.vertex_of.push_back(mesh_.vertex_source[mesh_.wedge_vertex[w]]);
    else
      r.extra_sources.push_back(mesh_.wedge_source[w]);
  }
  if (!input_.corner_normals.empty()) r.wedge_normals = mesh_.normals;
  r.faces.resize(mesh_.faces.size());
  if (!input_.materials.empty()) to.materials.resize(mesh_.faces.size());
  for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
    const std::uint32_t index = mesh_.face_index[f];
    r.faces[index] = {table_.at(3 * f), table_.at(3 * f + 1), table_.at(3 * f + 2)};
    if (!input_.materials.empty()) to.materials[index] = input_.materials[mesh_.face_source[f]];
  }
}

// From the mesh's numbers, along the curve, to the input's.
void Recorder::renumber() {
  for (VertexSplit& split : splits_) {
    split.child = mesh_.vertex_source[split.child];
    split.parent = mesh_.vertex_source[split.parent];
  }
  for (std::uint32_t& face : born_) face = mesh_.face_index[face];
  for (std::uint32_t& c : moved_) c = 3 * mesh_.face_index[c / 3] + c % 3;
}

void Recorder::add_splits(ProgressiveRecord& r) {
  const auto one = [](const VertexSplit&) { return 1; };
  r.born = reverse_groups(born_, splits_, [](const VertexSplit& s) { return s.n_born; });
  r.moved = reverse_groups(moved_, splits_, [](const VertexSplit& s) { return s.n_moved; });
  r.moved_by = reverse_groups(moved_by_, splits_, [](const VertexSplit& s) { return s.n_moved; });
  r.pairs = reverse_groups(pairs_, splits_, [](const VertexSplit& s) { return s.n_pairs; });
  if (is_full_) r.parent_positions = reverse_groups(parent_positions_, splits_, one);
  if (!parent_texcoords_.empty())
    r.parent_texcoords =
        reverse_groups(parent_texcoords_, splits_, [](const VertexSplit& s) { return s.n_pairs; });
  r.splits.assign(splits_.rbegin(), splits_.rend());
}

ProgressiveRecord Recorder::finish() {
  ProgressiveRecord r;
  renumber();
  add_splits(r);
  add_attributes(r);
  r.texcoords = std::move(texcoords_);
  return r;
}

}  // namespace viewcell
