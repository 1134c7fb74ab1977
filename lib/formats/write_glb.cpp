#include "formats/write_glb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <tuple>

#include "base/error.h"
#include "base/file.h"
#include "base/json.h"
#include "base/version.h"
#include "formats/split_normals.h"
#include "mesh/subset.h"
#include "mesh/tangents.h"

// Source: the glTF 2.0 specification (Khronos), 4.4 (GLB) and 3.6 (accessors).

namespace viewcell {
namespace {

static_assert(std::endian::native == std::endian::little, "GLB is written as it lies in memory");

constexpr int kGltfFloat = 5126, kGltfUnsignedShort = 5123, kGltfUnsignedInt = 5125;
constexpr int kVertexData = 34962, kIndexData = 34963;

// --- vertices: each a vertex of the mesh with one texture coordinate ---

struct DrawnVertices {
  std::vector<std::uint32_t> source;  // the mesh's vertex
  std::vector<glm::vec2> texcoords;   // ours, v up; empty without
  std::vector<glm::vec4> tangents;    // empty without
  std::vector<std::uint32_t> indices;
};

// Bits, so that every coordinate equals itself.
std::uint64_t bits_of(const glm::vec2& uv) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(uv.x)} << 32 |
         std::bit_cast<std::uint32_t>(uv.y);
}

// tangents: of corners, or empty. Corners of a vertex with the same texture coordinates, on the
// same side and of the same material, have the same one.
DrawnVertices split_vertices(const TriMesh& mesh, const std::vector<glm::vec4>& tangents) {
  const auto n = static_cast<std::uint32_t>(mesh.positions.size());
  DrawnVertices out;
  for (std::uint32_t v = 0; v < n; ++v) out.source.push_back(v);
  std::vector<bool> is_taken(n, false);
  if (!mesh.texcoords.empty()) out.texcoords.resize(n, glm::vec2(0));
  if (!tangents.empty()) out.tangents.resize(n, glm::vec4(1, 0, 0, 1));
  std::map<std::tuple<std::uint32_t, std::uint64_t, std::array<float, 4>>, std::uint32_t> copies;
  for (std::size_t corner = 0; corner < 3 * mesh.triangles.size(); ++corner) {
    const std::uint32_t v = mesh.triangles[corner / 3][corner % 3];
    out.indices.push_back(v);
    if (mesh.texcoords.empty()) continue;
    const glm::vec2& uv = mesh.texcoords[corner];
    const glm::vec4 tangent = tangents.empty() ? glm::vec4(0) : tangents[corner];
    if (!is_taken[v]) {
      out.texcoords[v] = uv;
      if (!tangents.empty()) out.tangents[v] = tangent;
    }
    is_taken[v] = true;
    const bool has_same = tangents.empty() || out.tangents[v] == tangent;
    if (bits_of(out.texcoords[v]) == bits_of(uv) && has_same) continue;
    const auto next = static_cast<std::uint32_t>(out.source.size());
    const auto [copy, is_new] =
        copies.try_emplace({v, bits_of(uv), {tangent.x, tangent.y, tangent.z, tangent.w}}, next);
    out.indices.back() = copy->second;
    if (!is_new) continue;
    out.source.push_back(v);
    out.texcoords.push_back(uv);
    if (!tangents.empty()) out.tangents.push_back(tangent);
  }
  return out;
}

// --- the binary chunk ---

// The buffer as it grows, and the JSON that tells what stands where in it.
struct Content {
  std::string bytes;
  Json views = Json::array(), accessors = Json::array();
  std::map<std::string, std::size_t> images;  // by their bytes
  std::map<GlbSampler, std::size_t> samplers;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> textures;  // of image and sampler
};

// target 0: none. Gives the view's number.
std::size_t add_view(Content& content, const void* data, std::size_t n_bytes, int target) {
  Json view{{"buffer", 0}, {"byteOffset", content.bytes.size()}, {"byteLength", n_bytes}};
  if (target != 0) view["target"] = target;
  content.views.push_back(std::move(view));
  content.bytes.append(static_cast<const char*>(data), n_bytes);
  content.bytes.resize((content.bytes.size() + 3) / 4 * 4, '\0');
  return content.views.size() - 1;
}

template <typename Element>
std::size_t add_accessor(Content& content, const std::vector<Element>& elements, int component_type,
                         const char* type, int target) {
  const std::size_t view =
      add_view(content, elements.data(), elements.size() * sizeof(Element), target);
  content.accessors.push_back({{"bufferView", view},
                               {"componentType", component_type},
                               {"count", elements.size()},
                               {"type", type}});
  return content.accessors.size() - 1;
}

std::vector<glm::vec3> pick(const std::vector<glm::vec3>& values,
                            const std::vector<std::uint32_t>& source) {
  std::vector<glm::vec3> out;
  out.reserve(source.size());
  for (const std::uint32_t v : source) out.push_back(values[v]);
  return out;
}

std::size_t add_positions(Content& content, const std::vector<glm::vec3>& positions) {
  const std::size_t id = add_accessor(content, positions, kGltfFloat, "VEC3", kVertexData);
  glm::vec3 lo = positions[0], hi = positions[0];
  for (const glm::vec3& p : positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
  content.accessors[id]["min"] = Json::array({lo.x, lo.y, lo.z});
  content.accessors[id]["max"] = Json::array({hi.x, hi.y, hi.z});
  return id;
}

// 65535 itself would be the mark that restarts a strip.
std::size_t add_indices(Content& content, const std::vector<std::uint32_t>& indices,
                        std::size_t n_vertices) {
  if (n_vertices > 65535)
    return add_accessor(content, indices, kGltfUnsignedInt, "SCALAR", kIndexData);
  const std::vector<std::uint16_t> small(indices.begin(), indices.end());
  return add_accessor(content, small, kGltfUnsignedShort, "SCALAR", kIndexData);
}

// What is given, or else the one material that base_color and normal_map make.
std::vector<GlbMaterial> materials_of(const GlbOptions& options) {
  if (!options.materials.empty()) return options.materials;
  return {{.name = "", .base_color = options.base_color, .normal_map = options.normal_map}};
}

bool has_picture(const std::vector<GlbMaterial>& materials, std::string GlbMaterial::*picture) {
  return std::any_of(materials.begin(), materials.end(),
                     [&](const GlbMaterial& m) { return !(m.*picture).empty(); });
}

// A normal map is relative to the tangents of the triangles that show it.
std::vector<glm::vec4> tangents_for(const TriMesh& mesh,
                                    const std::vector<GlbMaterial>& materials) {
  if (!has_picture(materials, &GlbMaterial::normal_map) || mesh.normals.empty()) return {};
  if (materials.size() == 1 || mesh.materials.empty())
    return make_corner_tangents(mesh, make_corner_normals(mesh));
  std::vector<glm::vec4> out(3 * mesh.triangles.size(), glm::vec4(1, 0, 0, 1));
  for (std::size_t m = 0; m < materials.size(); ++m) {
    std::vector<bool> is_kept;
    for (const std::int32_t material : mesh.materials)
      is_kept.push_back(static_cast<std::size_t>(material) == m);
    const TriMesh part = keep_triangles(mesh, is_kept);
    const std::vector<glm::vec4> tangents =
        part.triangles.empty() ? std::vector<glm::vec4>()
                               : make_corner_tangents(part, make_corner_normals(part));
    for (std::size_t c = 0, from = 0; c < out.size(); ++c)
      if (is_kept[c / 3]) out[c] = tangents[from++];
  }
  return out;
}

// Those of the triangles of each material; all are the first one's where the mesh has none.
std::vector<std::vector<std::uint32_t>> indices_by_material(const TriMesh& mesh,
                                                            const DrawnVertices& split,
                                                            std::size_t n_materials) {
  if (mesh.materials.empty() || n_materials == 1) return {split.indices};
  std::vector<std::vector<std::uint32_t>> out(n_materials);
  for (std::size_t i = 0; i < split.indices.size(); ++i)
    out[static_cast<std::size_t>(mesh.materials[i / 3])].push_back(split.indices[i]);
  return out;
}

Json add_primitives(Content& content, const TriMesh& mesh, const GlbOptions& options,
                    const std::vector<GlbMaterial>& materials) {
  const DrawnVertices split = split_vertices(mesh, tangents_for(mesh, materials));
  Json attributes{{"POSITION", add_positions(content, pick(mesh.positions, split.source))}};
  const auto add = [&](const char* name, const std::vector<glm::vec3>& values) {
    attributes[name] =
        add_accessor(content, pick(values, split.source), kGltfFloat, "VEC3", kVertexData);
  };
  if (!mesh.normals.empty()) add("NORMAL", mesh.normals);
  if (!split.texcoords.empty()) {
    std::vector<glm::vec2> turned = split.texcoords;
    for (glm::vec2& uv : turned) uv.y = 1 - uv.y;
    attributes["TEXCOORD_0"] = add_accessor(content, turned, kGltfFloat, "VEC2", kVertexData);
  }
  if (!split.tangents.empty())
    attributes["TANGENT"] = add_accessor(content, split.tangents, kGltfFloat, "VEC4", kVertexData);
  if (!mesh.colors.empty() && options.base_color.empty() && options.materials.empty())
    add("COLOR_0", mesh.colors);
  Json out = Json::array();
  const auto indices = indices_by_material(mesh, split, materials.size());
  for (std::size_t m = 0; m < indices.size(); ++m)
    if (!indices[m].empty())
      out.push_back({{"attributes", attributes},
                     {"indices", add_indices(content, indices[m], split.source.size())},
                     {"material", m}});
  return out;
}

// --- the JSON chunk ---

const char* mime_type(const std::string& picture, const std::string& file) {
  if (picture.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
  if (picture.starts_with("\xff\xd8\xff")) return "image/jpeg";
  throw InputError(file, "texture", "is neither PNG nor JPEG, which glTF holds");
}

std::size_t add_image(Content& content, Json& root, const std::string& picture,
                      const std::string& file) {
  const auto [found, is_new] = content.images.try_emplace(picture, content.images.size());
  if (is_new) {
    const char* type = mime_type(picture, file);
    const std::size_t view = add_view(content, picture.data(), picture.size(), 0);
    root["images"].push_back({{"bufferView", view}, {"mimeType", type}});
  }
  return found->second;
}

// What is glTF's default is not said, but for the filters, which have none.
std::size_t add_sampler(Content& content, Json& root, const GlbSampler& sampler) {
  const auto [found, is_new] = content.samplers.try_emplace(sampler, content.samplers.size());
  if (is_new) {
    Json json{{"magFilter", sampler.mag_filter}, {"minFilter", sampler.min_filter}};
    if (sampler.wrap_s != GlbSampler::kRepeat) json["wrapS"] = sampler.wrap_s;
    if (sampler.wrap_t != GlbSampler::kRepeat) json["wrapT"] = sampler.wrap_t;
    root["samplers"].push_back(json);
  }
  return found->second;
}

// Adds a picture's texture, once; gives what a material says of it.
Json add_texture(Content& content, Json& root, const std::string& picture,
                 const GlbSampler& sampler, const std::string& file) {
  const std::pair key{add_image(content, root, picture, file), add_sampler(content, root, sampler)};
  const auto [found, is_new] = content.textures.try_emplace(key, content.textures.size());
  if (is_new) root["textures"].push_back({{"sampler", key.second}, {"source", key.first}});
  return {{"index", found->second}};
}

// What is glTF's default is not said.
Json format_glb_material(Content& content, Json& root, const GlbMaterial& m,
                         const std::string& file) {
  Json out = Json::object();
  if (!m.name.empty()) out["name"] = m.name;
  Json& pbr = out["pbrMetallicRoughness"];
  pbr = {{"metallicFactor", m.metallic}, {"roughnessFactor", m.roughness}};
  const glm::dvec4& c = m.base_color_factor;
  if (c != glm::dvec4(1)) pbr["baseColorFactor"] = {c.x, c.y, c.z, c.w};
  if (!m.base_color.empty())
    pbr["baseColorTexture"] = add_texture(content, root, m.base_color, m.color_sampler, file);
  if (!m.normal_map.empty())
    out["normalTexture"] = add_texture(content, root, m.normal_map, m.normal_sampler, file);
  if (!m.normal_map.empty() && m.normal_scale != 1) out["normalTexture"]["scale"] = m.normal_scale;
  if (m.emissive != glm::dvec3(0))
    out["emissiveFactor"] = {m.emissive.x, m.emissive.y, m.emissive.z};
  if (m.alpha_mode != "OPAQUE") out["alphaMode"] = m.alpha_mode;
  if (m.alpha_mode == "MASK") out["alphaCutoff"] = m.alpha_cutoff;
  if (m.is_double_sided) out["doubleSided"] = true;
  return out;
}

Json make_root(Content& content, const TriMesh& mesh, const GlbOptions& options,
               const std::string& file) {
  const std::string generator =
      options.generator.empty() ? std::string("viewcell ") + version() : options.generator;
  Json root_node{{"mesh", 0}};
  const glm::dvec3& at = mesh.offset;
  if (at != glm::dvec3(0)) root_node["translation"] = Json::array({at.x, at.y, at.z});
  const Json scene{{"nodes", Json::array({0})}};
  Json root{{"asset", {{"version", "2.0"}, {"generator", generator}}},
            {"scene", 0},
            {"scenes", Json::array({scene})},
            {"nodes", Json::array({root_node})}};
  const std::vector<GlbMaterial> materials = materials_of(options);
  const Json primitives = add_primitives(content, mesh, options, materials);
  root["meshes"] = Json::array({Json{{"primitives", primitives}}});
  Json all = Json::array();
  for (const GlbMaterial& material : materials)
    all.push_back(format_glb_material(content, root, material, file));
  root["materials"] = all;
  root["accessors"] = content.accessors;
  root["bufferViews"] = content.views;
  root["buffers"] = Json::array({Json{{"byteLength", content.bytes.size()}}});
  return root;
}

// --- the file ---

void append_word(std::string& out, std::size_t word) {
  const auto bits = static_cast<std::uint32_t>(word);
  out.append(reinterpret_cast<const char*>(&bits), sizeof bits);
}

std::string join_chunks(std::string json, const std::string& binary, const std::string& file) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t n_bytes = 12 + 8 + json.size() + 8 + binary.size();
  if (n_bytes > std::numeric_limits<std::uint32_t>::max())
    throw InputError(file, "", "is too large for a GLB, which holds 4 GiB");
  std::string out = "glTF";
  append_word(out, 2);
  append_word(out, n_bytes);
  append_word(out, json.size());
  out += "JSON" + json;
  append_word(out, binary.size());
  return out.append("BIN\0", 4) + binary;
}

template <typename Vector>
void check_numbers(const std::vector<Vector>& values, const char* what, const std::string& file) {
  for (const Vector& value : values)
    for (int k = 0; k < Vector::length(); ++k)
      if (!std::isfinite(value[k]))
        throw InputError(file, what, "hold a number that is not finite");
}

void check_input(const TriMesh& mesh, const GlbOptions& options, const std::string& file) {
  const std::size_t n_corners = 3 * mesh.triangles.size();
  VIEWCELL_CHECK(n_corners > 0, file);
  VIEWCELL_CHECK(mesh.texcoords.empty() || mesh.texcoords.size() == n_corners,
                 mesh.texcoords.size(), n_corners);
  const std::vector<GlbMaterial> materials = materials_of(options);
  VIEWCELL_CHECK(!mesh.texcoords.empty() || (!has_picture(materials, &GlbMaterial::base_color) &&
                                             !has_picture(materials, &GlbMaterial::normal_map)),
                 "a texture without texture coordinates");
  for (const std::int32_t m : mesh.materials)
    VIEWCELL_CHECK(
        options.materials.empty() || (m >= 0 && static_cast<std::size_t>(m) < materials.size()), m,
        materials.size());
  check_numbers(mesh.positions, "positions", file);
  check_numbers(mesh.texcoords, "texture coordinates", file);
}

}  // namespace

void write_glb(const std::filesystem::path& file, const TriMesh& mesh, const GlbOptions& options,
               Remarks* remarks) {
  check_input(mesh, options, file.string());
  if (!mesh.corner_normals.empty())
    return write_glb(file, split_by_normals(mesh, remarks).mesh, options, remarks);
  const char* why = "which we do not write to a GLB, left out";
  if (options.materials.empty())
    add_remark(remarks, std::string("materials, ") + why, mesh.material_names.size());
  if (!options.base_color.empty() || !options.materials.empty())
    add_remark(remarks, std::string("colours of vertices under a texture, ") + why,
               mesh.colors.size());
  Content content;
  const Json root = make_root(content, mesh, options, file.string());
  write_file(file, join_chunks(root.dump(), content.bytes, file.string()));
}

}  // namespace viewcell
