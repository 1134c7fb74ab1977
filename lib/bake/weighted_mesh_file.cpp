#include "bake/weighted_mesh_file.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <sstream>

#include "base/error.h"
#include "base/file.h"
#include "formats/ply.h"

namespace viewcell {
namespace {

constexpr const char* kTitle = "viewcell-weighted-meshes 1";

const char* kind_name(Representation kind) {
  return kind == Representation::single_view ? "svmesh" : "mvmesh";
}

// "key value" among the comments; throws when absent.
std::string comment_value(const PlyDocument& document, const std::string& key) {
  for (const std::string& comment : document.comments)
    if (comment == key || comment.starts_with(key + " "))
      return comment.substr(std::min(comment.size(), key.size() + 1));
  throw InputError(document.file, "header", "has no comment '" + key + "'");
}

Representation parse_kind(const PlyDocument& document) {
  const std::string text = comment_value(document, "kind");
  for (const auto kind : {Representation::single_view, Representation::multi_view})
    if (text == kind_name(kind)) return kind;
  throw InputError(document.file, "header",
                   "its comment 'kind' says '" + text + "', neither svmesh nor mvmesh");
}

CellId parse_cell(const PlyDocument& document) {
  const std::string text = comment_value(document, "cell");
  const char* last = text.data() + text.size();
  std::int32_t number = -1;
  const auto [end, error] = std::from_chars(text.data(), last, number);
  if (error == std::errc() && end == last && number >= 0) return CellId(number);
  throw InputError(document.file, "header",
                   "its comment 'cell' says '" + text + "', which is no cell's number");
}

// What the comments say of the meshes.
WeightedMeshes parse_header(const PlyDocument& document) {
  if (document.comments.empty() || document.comments[0] != kTitle)
    throw InputError(document.file, "header", "is not a file of weighted meshes");
  return {parse_kind(document),
          parse_cell(document),
          comment_value(document, "captures"),
          comment_value(document, "made_from"),
          {}};
}

void check_kind_and_cell(const std::filesystem::path& file, const WeightedMeshes& found,
                         Representation kind, CellId cell) {
  if (found.kind != kind)
    throw InputError(file.string(), "header",
                     std::string("is of the other kind: its comment 'kind' says ") +
                         kind_name(found.kind) + ", not " + kind_name(kind) + "; run " +
                         kind_name(kind));
  if (found.cell != cell)
    throw InputError(file.string(), "header",
                     "is of another cell: its comment 'cell' says " +
                         std::to_string(index(found.cell)) + ", not " +
                         std::to_string(index(cell)));
}

// All columns of all meshes, one after another.
struct Columns {
  std::vector<glm::vec3> positions, normals;
  std::vector<float> weights;
  std::vector<std::uint8_t> vertex_views, triangle_views;
  std::vector<std::uint32_t> source_vertex;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> objects;

  void append(const CellMesh& mesh) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    const auto add = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    add(positions, mesh.vertices.positions);
    add(normals, mesh.vertices.normals);
    add(weights, mesh.vertices.weights);
    add(vertex_views, mesh.vertices.views);
    add(source_vertex, mesh.source_vertex);
    add(triangle_views, mesh.views);
    for (const Triangle& t : mesh.triangles)
      triangles.push_back({first + t[0], first + t[1], first + t[2]});
    objects.insert(objects.end(), mesh.triangles.size(), static_cast<std::int32_t>(mesh.object));
  }
};

// Meshes without faces, for the objects that the header lists and no face names. The list must be
// ascending and hold every object that a face names.
void add_empty_meshes(const PlyDocument& document, const Scene& scene,
                      std::vector<CellMesh>& meshes) {
  std::vector<CellMesh> all;
  std::istringstream list(comment_value(document, "objects"));
  std::size_t next = 0;  // of meshes
  for (long object = 0; list >> object;) {
    const bool in_range = object >= 0 && object < static_cast<long>(scene.objects.size());
    if (!in_range || (!all.empty() && object <= static_cast<long>(all.back().object)))
      throw InputError(document.file, "header", "its list of objects is out of order or range");
    if (next < meshes.size() && static_cast<long>(meshes[next].object) == object) {
      all.push_back(std::move(meshes[next++]));
    } else {
      all.emplace_back();
      all.back().object = ObjectId(object);
    }
  }
  if (next != meshes.size())
    throw InputError(document.file, "header", "its list of objects lacks one that has faces");
  meshes = std::move(all);
}

// Takes the rows of one object out of the document's columns.
class MeshSplitter {
 public:
  MeshSplitter(const PlyDocument& document, const Scene& scene) : document_(document) {
    columns_.positions = document.vec3s("vertex", "x", "y", "z");
    columns_.normals = document.vec3s("vertex", "nx", "ny", "nz");
    columns_.weights = document.floats("vertex", "weight");
    for (const auto v : document.uints("vertex", "views", 0x7f))
      columns_.vertex_views.push_back(static_cast<std::uint8_t>(v));
    columns_.source_vertex = document.uints("vertex", "source_vertex");
    columns_.triangles = document.triangles("face", "vertex_indices", columns_.positions.size());
    const auto n = static_cast<std::uint32_t>(scene.objects.size());
    if (n == 0 && !columns_.triangles.empty()) fail(0, "is of an object, and the scene has none");
    for (const auto o : document.uints("face", "object", n == 0 ? 0 : n - 1))
      columns_.objects.push_back(static_cast<std::int32_t>(o));
    for (const auto v : document.uints("face", "views", 0x7f))
      columns_.triangle_views.push_back(static_cast<std::uint8_t>(v));
  }

  std::vector<CellMesh> split(const Scene& scene) {
    std::vector<CellMesh> out;
    std::uint32_t vertex = 0;  // the first vertex that no mesh has taken yet
    for (std::size_t t = 0; t < columns_.triangles.size();) {
      std::size_t end = t;
      while (end < columns_.triangles.size() && columns_.objects[end] == columns_.objects[t]) ++end;
      if (!out.empty() && columns_.objects[t] <= static_cast<std::int32_t>(out.back().object))
        fail(t, "its object is out of order");
      out.push_back(take(t, end, vertex, scene));
      t = end;
    }
    return out;
  }

 private:
  [[noreturn]] void fail(std::size_t face, const std::string& what) const {
    throw InputError(document_.file, "face " + std::to_string(face), what);
  }

  CellMesh take(std::size_t begin, std::size_t end, std::uint32_t& vertex, const Scene& scene) {
    CellMesh mesh;
    mesh.object = ObjectId(columns_.objects[begin]);
    const std::uint32_t first = vertex;
    for (std::size_t t = begin; t < end; ++t) {
      Triangle local{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = columns_.triangles[t][k];
        if (v < first) fail(t, "uses a vertex of another object");
        vertex = std::max(vertex, v + 1);
        local[k] = v - first;
      }
      mesh.triangles.push_back(local);
      mesh.views.push_back(columns_.triangle_views[t]);
    }
    const std::size_t most = scene.mesh_of(scene.objects[index(mesh.object)]).mesh.positions.size();
    for (std::uint32_t v = first; v < vertex; ++v) {
      if (columns_.source_vertex[v] >= most)
        throw InputError(document_.file, "vertex " + std::to_string(v),
                         "source_vertex is out of the object's range");
      mesh.source_vertex.push_back(columns_.source_vertex[v]);
      mesh.vertices.positions.push_back(columns_.positions[v]);
      mesh.vertices.normals.push_back(columns_.normals[v]);
      mesh.vertices.weights.push_back(columns_.weights[v]);
      mesh.vertices.views.push_back(columns_.vertex_views[v]);
    }
    return mesh;
  }

  const PlyDocument& document_;
  Columns columns_;
};

}  // namespace

std::string weighted_mesh_name(CellId cell) {
  char name[32];
  std::snprintf(name, sizeof name, "cell-%05d.ply", static_cast<int>(cell));
  return name;
}

void write_weighted_meshes(const std::filesystem::path& file, const WeightedMeshes& meshes,
                           const std::string& provenance) {
  Columns columns;
  std::string objects;  // also those of which no face is left
  for (const CellMesh& mesh : meshes.meshes) {
    columns.append(mesh);
    objects += " " + std::to_string(static_cast<int>(mesh.object));
  }
  PlyDocument document;
  document.comments = {kTitle,
                       std::string("kind ") + kind_name(meshes.kind),
                       "cell " + std::to_string(static_cast<int>(meshes.cell)),
                       "captures " + meshes.captures,
                       "made_from " + meshes.made_from,
                       "made_by " + provenance,
                       "objects" + objects};
  PlyElement vertex;
  vertex.name = "vertex";
  vertex.count = columns.positions.size();
  add_vec3s(vertex, {"x", "y", "z"}, columns.positions);
  add_vec3s(vertex, {"nx", "ny", "nz"}, columns.normals);
  add_column(vertex, "weight", columns.weights);
  add_column(vertex, "views", columns.vertex_views);
  add_column(vertex, "source_vertex", columns.source_vertex);
  PlyElement face;
  face.name = "face";
  face.count = columns.triangles.size();
  add_triangles(face, "vertex_indices", columns.triangles);
  add_column(face, "object", columns.objects);
  add_column(face, "views", columns.triangle_views);
  document.elements = {std::move(vertex), std::move(face)};
  write_file(file, format_ply(document));
}

WeightedMeshes read_weighted_meshes(const std::filesystem::path& file, const Scene& scene) {
  refuse_special(file);
  const std::string bytes = read_file(file);
  const PlyDocument document = parse_ply(bytes, file.string());
  WeightedMeshes out = parse_header(document);
  out.file_hash = hash_hex(bytes);
  out.meshes = MeshSplitter(document, scene).split(scene);
  add_empty_meshes(document, scene, out.meshes);
  return out;
}

WeightedMeshes read_weighted_meshes(const std::filesystem::path& file, const Scene& scene,
                                    Representation kind, CellId cell) {
  std::error_code ignored;  // what cannot be looked at cannot be opened
  if (!std::filesystem::exists(file, ignored))
    throw InputError(file.string(), "",
                     std::string("is not there; run ") + kind_name(kind) + " for this cell");
  WeightedMeshes out = read_weighted_meshes(file, scene);
  check_kind_and_cell(file, out, kind, cell);
  return out;
}

bool is_derived(const std::filesystem::path& file, Representation kind, CellId cell,
                const std::string& made_from) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return false;
  refuse_special(file);
  WeightedMeshes found;
  try {
    found = parse_header(parse_ply(read_file(file), file.string()));
  } catch (const InputError&) {
    return false;  // damaged: derived again
  }
  check_kind_and_cell(file, found, kind, cell);
  return found.made_from == made_from;
}

}  // namespace viewcell
