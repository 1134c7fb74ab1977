// "materials" of scene.json (docs/formats.md, docs/schemas/scene.schema.json).
#include "scene/material_io.h"

#include <array>
#include <charconv>

#include "base/file.h"

namespace viewcell {
namespace {

constexpr std::array<const char*, 3> kWraps{"repeat", "clamp", "mirror"};
constexpr std::array<const char*, 2> kAlphas{"opaque", "mask"};
constexpr double kMostEmission = 100;
constexpr std::size_t kMostPictureBytes = std::size_t{1} << 30;

// The double whose shortest text is the float's: 0.48f is written 0.48, not 0.479999989.
double short_double(float x) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, x).ptr;
  double out = 0;
  std::from_chars(text, end, out);
  return out;
}

template <typename Enum, std::size_t n>
Enum enum_at(const JsonCursor& cursor, const std::array<const char*, n>& names) {
  const std::string name = cursor.string();
  std::string known;
  for (std::size_t i = 0; i < n; ++i) {
    if (name == names[i]) return static_cast<Enum>(i);
    known += std::string(i == 0 ? "" : (i + 1 == n ? " or " : ", ")) + names[i];
  }
  cursor.fail("'" + name + "' is not " + known);
}

}  // namespace

Json to_json(const glm::vec3& v) {
  return {short_double(v.x), short_double(v.y), short_double(v.z)};
}

bool is_of_version_1(const Material& m) {
  return m.opacity == 1 && m.alpha == AlphaMode::opaque && !m.has_vertex_colors && !m.is_unlit &&
         m.emissive == glm::vec3(0) && m.wrap_u == Wrap::repeat && m.wrap_v == Wrap::repeat;
}

Json to_json(const Material& m) {
  Json out = {{"name", m.name},
              {"base_color", to_json(m.base_color)},
              {"base_color_texture",
               m.base_color_texture.empty() ? Json(nullptr) : Json(m.base_color_texture)},
              {"double_sided", m.double_sided}};
  if (m.opacity != 1) out["opacity"] = short_double(m.opacity);
  if (m.alpha != AlphaMode::opaque) {
    out["alpha"] = kAlphas[static_cast<std::size_t>(m.alpha)];
    out["alpha_cutoff"] = short_double(m.alpha_cutoff);
  }
  if (m.has_vertex_colors) out["vertex_colors"] = true;
  if (m.is_unlit) out["unlit"] = true;
  if (m.emissive != glm::vec3(0)) out["emissive"] = to_json(m.emissive);
  if (m.wrap_u != Wrap::repeat || m.wrap_v != Wrap::repeat)
    out["wrap"] = {kWraps[static_cast<std::size_t>(m.wrap_u)],
                   kWraps[static_cast<std::size_t>(m.wrap_v)]};
  return out;
}

glm::vec3 color_at(const JsonCursor& cursor, double most) {
  const std::vector<double> c = cursor.numbers(3, 0, most);
  return {c[0], c[1], c[2]};
}

Material read_material(const JsonCursor& cursor) {
  Material m;
  m.name = cursor.at("name").string();
  m.base_color = color_at(cursor.at("base_color"), 1);
  const JsonCursor texture = cursor.at("base_color_texture");
  if (!texture.value().is_null()) {
    m.base_color_texture = texture.string();
    resolve_inside(cursor.file(), texture.place(), m.base_color_texture);
  }
  m.double_sided = cursor.at("double_sided").boolean();
  if (cursor.has("opacity")) m.opacity = static_cast<float>(cursor.at("opacity").number(0, 1));
  if (cursor.has("alpha")) m.alpha = enum_at<AlphaMode>(cursor.at("alpha"), kAlphas);
  if (cursor.has("alpha_cutoff"))
    m.alpha_cutoff = static_cast<float>(cursor.at("alpha_cutoff").number(0, 1));
  if (cursor.has("vertex_colors")) m.has_vertex_colors = cursor.at("vertex_colors").boolean();
  if (cursor.has("unlit")) m.is_unlit = cursor.at("unlit").boolean();
  if (cursor.has("emissive")) m.emissive = color_at(cursor.at("emissive"), kMostEmission);
  if (cursor.has("wrap")) {
    const JsonCursor wrap = cursor.at("wrap");
    if (wrap.size() != 2) wrap.fail("is not two words, of u and of v");
    m.wrap_u = enum_at<Wrap>(wrap.at(std::size_t{0}), kWraps);
    m.wrap_v = enum_at<Wrap>(wrap.at(std::size_t{1}), kWraps);
  }
  return m;
}

void remark_material_keys(const JsonCursor& material, Remarks& remarks) {
  constexpr const char* kKeys[] = {
      "name",         "base_color", "base_color_texture", "double_sided",  "opacity", "alpha",
      "alpha_cutoff", "unlit",      "emissive",           "vertex_colors", "wrap"};
  remark_unknown_keys(material, "a material", kKeys, &remarks);
}

void list_pictures(const std::filesystem::path& scene_file, Scene& scene) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    Material& material = scene.materials[i];
    if (material.base_color_texture.empty()) continue;
    const ScenePicture wanted{material.base_color_texture, "", material.cutoff(), {}};
    std::size_t at = 0;
    while (at < scene.pictures.size() &&
           (scene.pictures[at].file != wanted.file || scene.pictures[at].cutoff != wanted.cutoff))
      ++at;
    material.picture = static_cast<int>(at);
    if (at < scene.pictures.size()) continue;
    const std::string place = "materials[" + std::to_string(i) + "].base_color_texture";
    const auto file = resolve_inside(scene_file, place, wanted.file);
    scene.pictures.push_back(wanted);
    scene.pictures.back().hash = hash_hex(read_file(file, kMostPictureBytes));
  }
}

}  // namespace viewcell
