// scene.json (docs/formats.md, docs/schemas/scene.schema.json).
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"
#include "formats/mesh_file.h"
#include "mesh/backs.h"
#include "mesh/used_vertices.h"
#include "mesh/weld.h"
#include "scene/material_io.h"
#include "scene/scene.h"

namespace viewcell {
namespace {

constexpr const char* kSceneFormat = "viewcell-scene";
constexpr double kMaxCoordinate = 1e7;   // beyond it, float geometry has lost the park's detail
constexpr double kUnitTolerance = 1e-3;  // a direction or quaternion written with few digits
constexpr double kMinScale = 1e-9, kMaxScale = 1e9;
constexpr std::size_t kMostSlots = 1 << 16;  // materials of one mesh

// --- writing ---

Json to_json(const SceneMesh& mesh) {
  VIEWCELL_CHECK(!mesh.hash.empty() && mesh.n_triangles > 0, mesh.name);
  Json out = {{"name", mesh.name},
              {"file", mesh.file},
              {"up", mesh.up},
              {"scale", mesh.scale},
              {"triangles", mesh.n_triangles},
              {"hash", mesh.hash},
              {"substitutes", mesh.substitutes}};
  if (mesh.place != "file") out["place"] = mesh.place;
  return out;
}

Json to_json(const SceneObject& object) {
  const glm::dquat& q = object.rotation;
  const glm::dvec3& t = object.translation;
  Json out = {{"name", object.name}, {"mesh", index(object.mesh)}};
  if (object.materials.size() == 1)
    out["material"] = object.materials[0];
  else
    out["materials"] = object.materials;
  out["translation"] = {t.x, t.y, t.z};
  out["rotation"] = {q.x, q.y, q.z, q.w};
  out["scale"] = object.scale;
  return out;
}

template <typename T>
Json array_to_json(const std::vector<T>& items) {
  Json array = Json::array();
  for (const T& item : items) array.push_back(to_json(item));
  return array;
}

// --- reading ---

Area read_area(const JsonCursor& cursor) {
  const auto lo = cursor.at("lo").numbers(2, -kMaxCoordinate, kMaxCoordinate);
  const auto hi = cursor.at("hi").numbers(2, -kMaxCoordinate, kMaxCoordinate);
  if (!(lo[0] < hi[0] && lo[1] < hi[1])) cursor.fail("is empty: lo is not below hi");
  return {{lo[0], lo[1]}, {hi[0], hi[1]}};
}

Lighting read_lighting(const JsonCursor& root) {
  constexpr double kMostLight = 100;
  const JsonCursor light = root.at("light");
  Lighting out;
  const auto d = light.at("toward_light").numbers(3, -2, 2);
  const glm::dvec3 toward(d[0], d[1], d[2]);
  if (!(std::abs(glm::length(toward) - 1) <= kUnitTolerance))
    light.at("toward_light").fail("is not a unit vector");
  out.toward_light = glm::vec3(toward);
  out.light = color_at(light.at("color"), kMostLight);
  out.ambient_sky = color_at(light.at("ambient_sky"), kMostLight);
  out.ambient_ground = color_at(light.at("ambient_ground"), kMostLight);
  out.sky_color = color_at(root.at("sky").at("color"), 1);
  out.ground_color = color_at(root.at("ground").at("color"), 1);
  return out;
}

SceneMesh read_mesh_entry(const JsonCursor& cursor) {
  SceneMesh mesh;
  mesh.name = cursor.at("name").string();
  mesh.file = cursor.at("file").string();
  resolve_inside(cursor.file(), cursor.at("file").place(), mesh.file);
  mesh.up = cursor.at("up").string();
  if (!is_up_axis(mesh.up))
    cursor.at("up").fail("'" + mesh.up + "' is not x, y or z, or -x, -y, -z");
  mesh.scale = cursor.at("scale").number(kMinScale, kMaxScale);
  if (cursor.has("place")) mesh.place = cursor.at("place").string();
  if (mesh.place != "file" && mesh.place != "centre" && mesh.place != "ground")
    cursor.at("place").fail("'" + mesh.place + "' is not file, centre or ground");
  if (cursor.has("triangles"))
    mesh.n_triangles = static_cast<std::size_t>(cursor.at("triangles").integer(1, 1LL << 32));
  if (cursor.has("hash")) mesh.hash = cursor.at("hash").string();
  if (cursor.has("substitutes")) mesh.substitutes = cursor.at("substitutes").string();
  return mesh;
}

SceneObject read_object(const JsonCursor& cursor, const Scene& scene) {
  const auto index_into = [&](const JsonCursor& at, std::size_t n) {
    const auto value = at.integer(-(1LL << 40), 1LL << 40);
    if (value < 0 || value >= static_cast<std::int64_t>(n))
      at.fail(std::to_string(value) + " is out of range: there are " + std::to_string(n));
    return static_cast<std::int32_t>(value);
  };
  SceneObject object;
  object.name = cursor.at("name").string();
  object.mesh = MeshId(index_into(cursor.at("mesh"), scene.meshes.size()));
  if (cursor.has("materials") && cursor.has("material"))
    cursor.fail("has both \"material\" and \"materials\"");
  if (cursor.has("materials")) {
    const JsonCursor list = cursor.at("materials");
    object.materials.clear();
    for (std::size_t i = 0; i < list.size(kMostSlots); ++i)
      object.materials.push_back(index_into(list.at(i), scene.materials.size()));
    if (object.materials.empty()) list.fail("is empty");
  } else {
    object.materials = {index_into(cursor.at("material"), scene.materials.size())};
  }
  const auto t = cursor.at("translation").numbers(3, -kMaxCoordinate, kMaxCoordinate);
  object.translation = {t[0], t[1], t[2]};
  const auto q = cursor.at("rotation").numbers(4, -2, 2);
  const glm::dquat rotation(q[3], q[0], q[1], q[2]);
  const double length = glm::length(rotation);
  if (!(std::abs(length - 1) <= kUnitTolerance))
    cursor.at("rotation").fail("is not a unit quaternion (x, y, z, w)");
  // A quaternion that is unit up to rounding stays as it is: reading what was written changes
  // nothing.
  object.rotation = std::abs(length - 1) < 1e-12 ? rotation : rotation / length;
  object.scale = cursor.at("scale").number(kMinScale, kMaxScale);
  return object;
}

// Positions about the middle of the box of the vertices that triangles use.
void centre_positions(TriMesh& mesh) {
  const Box box = surface_box(mesh);
  for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dvec3(p) - box.centre());
  mesh.offset = glm::dvec3(0);
}

// Turns the file's up axis to z and applies its scale.
void apply_up_and_scale(SceneMesh& mesh) {
  const glm::dmat3 turn(glm::dvec3(turn_up_axis(mesh.up, {1, 0, 0})),
                        glm::dvec3(turn_up_axis(mesh.up, {0, 1, 0})),
                        glm::dvec3(turn_up_axis(mesh.up, {0, 0, 1})));
  mesh.mesh.offset = mesh.scale * (turn * mesh.mesh.offset);
  for (glm::vec3& p : mesh.mesh.positions)
    p = turn_up_axis(mesh.up, p) * static_cast<float>(mesh.scale);
  for (glm::vec3& n : mesh.mesh.normals) n = turn_up_axis(mesh.up, n);
  for (glm::vec3& n : mesh.mesh.corner_normals) n = turn_up_axis(mesh.up, n);
}

// After that: the middle of what triangles show at x = y = 0, its lowest point at z = 0.
void set_on_ground(TriMesh& mesh) {
  const Box box = surface_box(mesh);
  const glm::dvec3 foot(box.centre().x, box.centre().y, box.lo.z);
  for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dvec3(p) - foot);
  mesh.offset = glm::dvec3(0);
}

// Reads and checks one mesh file; place: "meshes[3]". Returns what is to be said of it.
FileRemarks load_mesh(const std::filesystem::path& scene_file, const std::string& place,
                      const MeshLimits& limits, const SplitOptions& by, SceneMesh& mesh) {
  const std::filesystem::path file = resolve_inside(scene_file, place + ".file", mesh.file);
  MeshSource source;
  mesh.mesh = read_mesh(file, &source, limits);
  if (!mesh.hash.empty() && mesh.hash != source.hash)
    throw InputError(file.string(), "", "mesh file changed since the scene was written");
  mesh.hash = source.hash;
  const std::size_t n = mesh.mesh.triangles.size();
  if (n == 0) throw InputError(file.string(), "", "mesh has no faces");
  if (mesh.n_triangles != 0 && mesh.n_triangles != n)
    throw InputError(
        scene_file.string(), place + ".triangles",
        std::to_string(mesh.n_triangles) + ", but '" + mesh.file + "' has " + std::to_string(n));
  mesh.n_triangles = n;
  mesh.n_slots = std::max<std::size_t>(mesh.mesh.material_names.size(), 1);
  if (mesh.place == "centre") centre_positions(mesh.mesh);
  apply_up_and_scale(mesh);
  if (mesh.place == "ground") set_on_ground(mesh.mesh);
  const Box box = bounding_box(mesh.mesh);
  const glm::dvec3 lo = box.lo + mesh.mesh.offset, hi = box.hi + mesh.mesh.offset;
  for (int axis = 0; axis < 3; ++axis)
    if (!(lo[axis] >= -kMaxCoordinate && hi[axis] <= kMaxCoordinate))
      throw InputError(file.string(), "", "coordinates leave +-1e7 after scaling");
  const BorderWeld closed = close_cracks(mesh.mesh);
  add_remark(&source.remarks, "vertices moved onto others next to them, so that cracks close",
             closed.n_welded);
  add_remark(&source.remarks, kBacksRecut, cut_backs_alike(mesh.mesh));
  SplitMesh split = split_corners(std::move(mesh.mesh), by);
  mesh.mesh = std::move(split.mesh);
  mesh.weld = std::move(split.weld);
  mesh.looks = std::move(split.looks);
  mesh.has_twins = split.has_twins;
  return {file, source.remarks};
}

// What the vertices of each mesh are split by: what some of its objects shows.
std::vector<SplitOptions> choose_splits(const Scene& scene) {
  std::vector<SplitOptions> out(scene.meshes.size());
  for (const SceneObject& object : scene.objects) {
    SplitOptions& by = out[index(object.mesh)];
    by.materials |= object.materials.size() > 1;
    for (const int material : object.materials)
      by.texcoords |= scene.materials[static_cast<std::size_t>(material)].picture >= 0;
  }
  return out;
}

void load_meshes(const std::filesystem::path& file, const ReadSceneOptions& options, Scene& scene) {
  const std::vector<SplitOptions> splits = choose_splits(scene);
  std::vector<FileRemarks> remarks(scene.meshes.size());
  parallel_for(scene.meshes.size(), options.n_threads, [&](std::size_t i) {
    SceneMesh& mesh = scene.meshes[i];
    if (options.with_meshes || mesh.hash.empty() || mesh.n_triangles == 0)
      remarks[i] =
          load_mesh(file, "meshes[" + std::to_string(i) + "]", options.limits, splits[i], mesh);
    if (!options.with_meshes) mesh.mesh = {}, mesh.weld = {}, mesh.looks = {};
  });
  for (FileRemarks& of_mesh : remarks)
    if (!of_mesh.remarks.empty()) scene.remarks.push_back(std::move(of_mesh));
}

void remark_scene_keys(const JsonCursor& root, Remarks& remarks) {
  constexpr const char* kScene[] = {"format", "version", "made_by",   "name",   "area",   "ground",
                                    "sky",    "light",   "materials", "meshes", "objects"};
  constexpr const char* kArea[] = {"lo", "hi"};
  constexpr const char* kGround[] = {"z", "color"};
  constexpr const char* kSky[] = {"color"};
  constexpr const char* kLight[] = {"toward_light", "color", "ambient_sky", "ambient_ground"};
  constexpr const char* kMesh[] = {"name",  "file",      "up",   "scale",
                                   "place", "triangles", "hash", "substitutes"};
  constexpr const char* kObject[] = {"name",        "mesh",     "material", "materials",
                                     "translation", "rotation", "scale"};
  remark_unknown_keys(root, "the scene", kScene, &remarks);
  remark_unknown_keys(root.at("area"), "area", kArea, &remarks);
  remark_unknown_keys(root.at("ground"), "ground", kGround, &remarks);
  remark_unknown_keys(root.at("sky"), "sky", kSky, &remarks);
  remark_unknown_keys(root.at("light"), "light", kLight, &remarks);
  const auto each = [&](const char* array, const char* what, std::span<const char* const> known) {
    for (std::size_t i = 0; i < root.at(array).size(); ++i)
      remark_unknown_keys(root.at(array).at(i), what, known, &remarks);
  };
  for (std::size_t i = 0; i < root.at("materials").size(); ++i)
    remark_material_keys(root.at("materials").at(i), remarks);
  each("meshes", "a mesh", kMesh);
  each("objects", "an object", kObject);
}

// Once the meshes are known: an object gives a material for each of its mesh's.
void check_slots(const std::string& file, const Scene& scene, const ReadSceneOptions& options) {
  for (std::size_t i = 0; i < scene.objects.size() && options.with_meshes; ++i) {
    const SceneObject& object = scene.objects[i];
    const SceneMesh& mesh = scene.mesh_of(object);
    if (object.materials.size() > 1 && object.materials.size() != mesh.n_slots)
      throw InputError(file, "objects[" + std::to_string(i) + "].materials",
                       std::to_string(object.materials.size()) + ", but '" + mesh.file + "' has " +
                           std::to_string(mesh.n_slots));
  }
}

// What materials ask for and meshes have not.
void remark_missing(const Scene& scene, const ReadSceneOptions& options, Remarks& remarks) {
  std::size_t n_texcoords = 0, n_colors = 0;
  for (const SceneObject& object : scene.objects) {
    bool has_picture = false, has_colors = false;
    for (const int m : object.materials) {
      const Material& material = scene.materials[static_cast<std::size_t>(m)];
      has_picture |= material.picture >= 0;
      has_colors |= material.has_vertex_colors;
    }
    const SceneMesh& mesh = scene.mesh_of(object);
    n_texcoords += has_picture && mesh.looks.texcoords.empty();
    n_colors += has_colors && mesh.mesh.colors.empty();
  }
  if (!options.with_meshes) return;
  add_remark(&remarks, "objects without texture coordinates, drawn without their picture",
             n_texcoords);
  add_remark(&remarks, "objects without vertex colours, drawn without them", n_colors);
}

// Places an object whose mesh is about an offset, and refuses it where floats, which everything is
// drawn with, would show: a step of 2^-12 of its size is a quarter of a pixel of a thousand.
void place_object(const std::string& file, std::size_t id, const SceneMesh& mesh,
                  SceneObject& object) {
  constexpr double kMostStepShare = 0x1p-12;
  if (mesh.mesh.offset == glm::dvec3(0)) return;
  object.mesh_offset_world = object.rotation * (object.scale * mesh.mesh.offset);
  Box box;
  for (const glm::vec3& p : mesh.mesh.positions) box.add(object.world_from_model(glm::dvec3(p)));
  const glm::dvec3 reach = glm::max(glm::abs(box.lo), glm::abs(box.hi)), size = box.size();
  const double most = std::max({reach.x, reach.y, reach.z});
  const double step = std::ldexp(1.0, std::ilogb(most) - 23);  // between floats
  if (step <= kMostStepShare * std::max({size.x, size.y, size.z})) return;
  throw InputError(file, "objects[" + std::to_string(id) + "].translation",
                   "takes '" + mesh.name + "' to where floats are " + std::to_string(step) +
                       " apart: its file has it far from the origin. Say \"place\": \"centre\" of "
                       "the mesh, or move the object near the origin");
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const ReadSceneOptions& options) {
  Scene scene;
  const Json json = read_json(file, kSceneFormat, {1, 2}, "", &scene.file_hash);
  const JsonCursor root(json, file);
  scene.name = root.at("name").string();
  scene.area = read_area(root.at("area"));
  scene.lighting = read_lighting(root);
  scene.ground_z = root.at("ground").at("z").number(-kMaxCoordinate, kMaxCoordinate);
  const auto each = [&](const char* key, const auto& read) {
    const JsonCursor array = root.at(key);
    const std::size_t n = array.size();
    for (std::size_t i = 0; i < n; ++i) read(array.at(i));
  };
  each("materials", [&](const JsonCursor& at) { scene.materials.push_back(read_material(at)); });
  each("meshes", [&](const JsonCursor& at) { scene.meshes.push_back(read_mesh_entry(at)); });
  each("objects", [&](const JsonCursor& at) { scene.objects.push_back(read_object(at, scene)); });
  Remarks remarks;
  remark_scene_keys(root, remarks);
  list_pictures(file, scene);
  load_meshes(file, options, scene);
  check_slots(file.string(), scene, options);
  remark_missing(scene, options, remarks);
  if (!remarks.empty()) scene.remarks.insert(scene.remarks.begin(), {file, std::move(remarks)});
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    place_object(file.string(), i, scene.mesh_of(scene.objects[i]), scene.objects[i]);
  std::string hashes = hash_hex(json.dump());
  for (const SceneMesh& mesh : scene.meshes) hashes += mesh.hash;
  for (const ScenePicture& picture : scene.pictures) hashes += picture.hash;
  scene.hash = hash_hex(hashes);
  return scene;
}

Json format_scene(const Scene& scene, const Json& provenance) {
  const Lighting& l = scene.lighting;
  const bool is_version_1 =
      std::all_of(scene.materials.begin(), scene.materials.end(), is_of_version_1) &&
      std::all_of(scene.objects.begin(), scene.objects.end(),
                  [](const SceneObject& object) { return object.materials.size() == 1; });
  return {
      {"format", kSceneFormat},
      {"version", is_version_1 ? 1 : 2},
      {"made_by", provenance},
      {"name", scene.name},
      {"area",
       {{"lo", {scene.area.lo.x, scene.area.lo.y}}, {"hi", {scene.area.hi.x, scene.area.hi.y}}}},
      {"ground", {{"z", scene.ground_z}, {"color", to_json(l.ground_color)}}},
      {"sky", {{"color", to_json(l.sky_color)}}},
      {"light",
       {{"toward_light", to_json(l.toward_light)},
        {"color", to_json(l.light)},
        {"ambient_sky", to_json(l.ambient_sky)},
        {"ambient_ground", to_json(l.ambient_ground)}}},
      {"materials", array_to_json(scene.materials)},
      {"meshes", array_to_json(scene.meshes)},
      {"objects", array_to_json(scene.objects)}};
}

}  // namespace viewcell
