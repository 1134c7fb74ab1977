#include "park/models.h"

#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"
#include "formats/mesh_file.h"
#include "mesh/split_corners.h"
#include "mesh/used_vertices.h"
#include "park/statues.h"
#include "pm/simplify.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

// A model that models.json, or a file's name, offers for a kind.
struct Offer {
  fs::path file;
  std::string up = "z";
  double rotate_z_deg = 0;
  std::string substitutes;
};

using Offers = std::vector<std::optional<Offer>>;  // one a kind

std::optional<std::size_t> find_kind(const std::string& name) {
  for (std::size_t k = 0; k < kStatueKinds; ++k)
    if (statue_kinds()[k].name == name) return k;
  return {};
}

std::string list_kinds() {
  std::string names;
  for (const StatueKind& kind : statue_kinds())
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

Offer read_offer(const JsonCursor& cursor) {
  Offer offer;
  offer.file = resolve_inside(cursor.file(), cursor.at("file").place(), cursor.at("file").string());
  if (cursor.has("up")) offer.up = cursor.at("up").string();
  if (!is_up_axis(offer.up))
    cursor.at("up").fail("'" + offer.up + "' is not x, y or z, or -x, -y, -z");
  if (cursor.has("rotate_z_deg")) offer.rotate_z_deg = cursor.at("rotate_z_deg").number(-360, 360);
  if (cursor.has("substitutes")) offer.substitutes = cursor.at("substitutes").string();
  return offer;
}

Offers read_offers(const fs::path& list, Remarks& remarks) {
  constexpr const char* kList[] = {"format", "version", "made_by", "models"};
  // The last three are of scripts/fetch-models, for people.
  constexpr const char* kModel[] = {"name",        "file",      "up",     "rotate_z_deg",
                                    "substitutes", "triangles", "source", "sha256"};
  const Json json = read_json(list, "viewcell-models", 1);
  remark_unknown_keys(JsonCursor(json, list), "the list", kList, &remarks);
  const JsonCursor models = JsonCursor(json, list).at("models");
  Offers offers(kStatueKinds);
  const std::size_t n = models.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::string name = models.at(i).at("name").string();
    const auto kind = find_kind(name);
    if (!kind)
      models.at(i).at("name").fail("'" + name + "' is not a kind of statue; kinds are " +
                                   list_kinds());
    if (offers[*kind]) models.at(i).at("name").fail("'" + name + "' is there twice");
    offers[*kind] = read_offer(models.at(i));
    remark_unknown_keys(models.at(i), "a model", kModel, &remarks);
  }
  return offers;
}

Offers find_offers(const fs::path& folder) {
  Offers offers(kStatueKinds);
  for (std::size_t k = 0; k < kStatueKinds; ++k)
    for (const char* extension :
         {".ply", ".ply.gz", ".obj", ".off", ".stl", ".glb", ".gltf", ".3ds"}) {
      const fs::path file = folder / (std::string(statue_kinds()[k].name) + extension);
      if (offers[k] || !fs::is_regular_file(file)) continue;
      offers[k] = Offer{}, offers[k]->file = file;
    }
  return offers;
}

void turn_upright(TriMesh& mesh, const Offer& offer) {
  const double c = std::cos(glm::radians(offer.rotate_z_deg));
  const double s = std::sin(glm::radians(offer.rotate_z_deg));
  const auto turn = [&](const glm::vec3& p) {
    const glm::dvec3 q(turn_up_axis(offer.up, p));
    return glm::vec3(c * q.x - s * q.y, s * q.x + c * q.y, q.z);
  };
  for (glm::vec3& p : mesh.positions) p = turn(p);
  for (glm::vec3& n : mesh.normals) n = turn(n);
  for (glm::vec3& n : mesh.corner_normals) n = turn(n);
}

void set_on_ground(TriMesh& mesh, const glm::dvec3& size, const fs::path& file) {
  const Box box = bounding_box(mesh);
  const glm::dvec3 own = box.size();
  if (!(own.x > 0 && own.y > 0 && own.z > 0))
    throw InputError(file.string(), "", "the mesh is flat");
  const double scale = std::cbrt(size.x * size.y * size.z / (own.x * own.y * own.z));
  const glm::dvec3 base(box.centre().x, box.centre().y, box.lo.z);
  for (glm::vec3& p : mesh.positions) p = glm::vec3((glm::dvec3(p) - base) * scale);
  mesh.offset = glm::dvec3(0);  // of no account any more
}

// The surface hangs together where the file has split it; the result is split where normals jump.
TriMesh simplify_drawn(const SplitMesh& drawn, std::size_t n_triangles) {
  TriMesh surface;
  surface.positions = drawn.mesh.positions;
  surface.triangles = drawn.weld.weld(drawn.mesh.triangles);
  const SimplifyResult coarse = simplify(surface, {.target_triangles = n_triangles});
  std::vector<Triangle> triangles = coarse.mesh.triangles;
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) v = coarse.source_vertex[v];
  return compact(drawn.mesh, choose_drawn_vertices(drawn.mesh, drawn.weld, triangles)).mesh;
}

TriMesh load_model(const StatueKind& kind, const Offer& offer, const MeshLimits& limits,
                   MeshSource& source) {
  TriMesh mesh = read_mesh(offer.file, &source, limits);
  mesh.texcoords.clear(), mesh.materials.clear(), mesh.material_names.clear();
  mesh.material_libraries.clear();
  turn_upright(mesh, offer);
  set_on_ground(mesh, kind.size, offer.file);
  SplitMesh drawn = split_corners(std::move(mesh));
  return drawn.mesh.triangles.size() > kind.n_triangles ? simplify_drawn(drawn, kind.n_triangles)
                                                        : std::move(drawn.mesh);
}

// source: of the model's file, where there is one.
SceneMesh make_park_mesh(const StatueKind& kind, const std::optional<Offer>& offer, int n_threads,
                         const MeshLimits& limits, MeshSource& source) {
  SceneMesh mesh;
  mesh.name = kind.name;
  mesh.file = std::string("meshes/") + kind.name + ".ply";
  if (offer) {
    mesh.mesh = load_model(kind, *offer, limits, source);
    mesh.substitutes = offer->substitutes;
  } else {
    mesh.mesh = make_statue(kind, n_threads);
    mesh.substitutes = std::string("procedural, ") + kind.figure;
  }
  mesh.n_triangles = mesh.mesh.triangles.size();
  return mesh;
}

}  // namespace

ParkMeshes make_park_meshes(const fs::path& folder, int n_threads, const MeshLimits& limits) {
  ParkMeshes out;
  Offers offers(kStatueKinds);
  if (!folder.empty()) {
    if (!fs::is_directory(folder))
      throw InputError(folder.string(), "", "is not a folder of models");
    const fs::path list = folder / "models.json";
    refuse_special(list);
    Remarks remarks;
    offers = fs::exists(list) ? read_offers(list, remarks) : find_offers(folder);
    if (!remarks.empty()) out.remarks.push_back({list, std::move(remarks)});
  }
  out.meshes.resize(kStatueKinds);
  out.source_hashes.resize(kStatueKinds);
  std::vector<MeshSource> sources(kStatueKinds);
  parallel_for(kStatueKinds, n_threads, [&](std::size_t k) {
    out.meshes[k] = make_park_mesh(statue_kinds()[k], offers[k], n_threads, limits, sources[k]);
  });
  for (std::size_t k = 0; k < kStatueKinds; ++k) {
    out.source_hashes[k] = sources[k].hash;
    if (!sources[k].remarks.empty())
      out.remarks.push_back({offers[k]->file, std::move(sources[k].remarks)});
  }
  for (std::size_t k = 0; k < kStatueKinds && !folder.empty(); ++k) {
    const std::string name = statue_kinds()[k].name;
    if (!offers[k])
      out.notes.push_back(name + ": no model in " + folder.string() + ", procedural instead");
    if (offers[k] && !offers[k]->substitutes.empty())
      out.notes.push_back(name + ": " + offers[k]->substitutes);
  }
  return out;
}

}  // namespace viewcell
