#include "formats/face_list.h"

#include "formats/format_number.h"
#include "mesh/offset.h"
#include "mesh/triangulate.h"

namespace viewcell {
namespace {

template <typename PlaceOf>
Box box_of(std::span<const std::uint32_t> corners, std::size_t n_vertices, const PlaceOf& place) {
  Box box;
  for (const std::uint32_t v : corners) box.add(place(v));
  if (corners.empty())
    for (std::size_t v = 0; v < n_vertices; ++v) box.add(place(v));
  return box;
}

void remark_offset(const TriMesh& mesh, Remarks* remarks) {
  if (mesh.offset != glm::dvec3(0))
    add_remark(
        remarks,
        "far from the origin: positions are kept about (" + format_offset(mesh.offset, ", ") + ")",
        mesh.positions.size());
}

}  // namespace

void cut_faces(const FaceList& faces, TriMesh& mesh, TriangleSources* sources, Remarks* remarks) {
  std::vector<glm::vec3> points;
  std::vector<Triangle> cut;
  std::size_t n_short = 0, n_crossed = 0;
  mesh.triangles.reserve(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::uint64_t first = faces.starts[f], n = faces.starts[f + 1] - first;
    n_short += n < 3;
    if (n < 3) continue;
    points.clear(), cut.clear();
    for (std::uint64_t c = first; c < first + n; ++c)
      points.push_back(mesh.positions[faces.vertices[c]]);
    n_crossed += triangulate_polygon(points, cut) == PolygonCut::crossed;
    for (const Triangle& t : cut) {
      mesh.triangles.push_back({faces.vertices[first + t[0]], faces.vertices[first + t[1]],
                                faces.vertices[first + t[2]]});
      if (sources == nullptr) continue;
      for (const std::uint32_t corner : t) sources->corners.push_back(first + corner);
      sources->faces.push_back(static_cast<std::uint32_t>(f));
    }
  }
  add_remark(remarks, "faces of fewer than three corners, left out", n_short);
  add_remark(remarks, "polygons that cross themselves or have no area, cut into fans", n_crossed);
}

void place_vertices(std::span<const glm::dvec3> places, std::span<const std::uint32_t> corners,
                    TriMesh& mesh, Remarks* remarks, const std::optional<glm::dvec3>& stated) {
  const Box box = box_of(corners, places.size(), [&](std::size_t v) { return places[v]; });
  const bool takes_stated = stated && is_offset_near(box, *stated);
  place_vertices(mesh, places, takes_stated ? *stated : choose_offset(box));
  remark_offset(mesh, remarks);
}

void choose_offset_of(std::span<const std::uint32_t> corners, TriMesh& mesh, Remarks* remarks) {
  change_offset(mesh, choose_offset(box_of(corners, mesh.positions.size(),
                                           [&](std::size_t v) { return place_of(mesh, v); })));
  remark_offset(mesh, remarks);
}

}  // namespace viewcell
