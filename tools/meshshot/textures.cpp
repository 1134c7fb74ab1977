#include "meshshot/textures.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/srgb.h"
#include "common/picture_input.h"
#include "formats/material_pictures.h"
#include "image/index_map.h"
#include "mesh/subset.h"

namespace viewcell {
namespace {

// A texture of one texel, for a material without a picture.
ImageRgba8 make_plain(const GlbMaterial& look) {
  Rgba8 texel{0, 0, 0, 255};
  for (int k = 0; k < 3; ++k)
    texel[static_cast<std::size_t>(k)] =
        srgb8_from_linear(static_cast<float>(look.base_color_factor[k]));
  return ImageRgba8(1, 1, texel);
}

// Of each of the mesh's materials the picture's number, or -1 - its own number.
std::vector<int> pictures_of(const MeshshotArguments& o, const TriMesh& mesh,
                             const MaterialPictures& model) {
  std::vector<int> out;
  for (const std::string& name : mesh.material_names) {
    const PicturedMaterial* found = find_material(model, name);
    if (found == nullptr && name != "default")
      throw InputError(o.mesh_file, "", "its material '" + name + "' is none of " + o.texture);
    const int own = -1 - static_cast<int>(out.size());
    out.push_back(found == nullptr || found->color < 0 ? own : found->color);
  }
  return out;
}

void append(TriMesh& to, const TriMesh& part) {
  const auto add = [](auto& all, const auto& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  add(to.triangles, part.triangles);
  add(to.texcoords, part.texcoords);
  add(to.corner_normals, part.corner_normals);
  add(to.materials, part.materials);
}

ImageRgba8 texture_of_run(const Tool& tool, const MeshshotArguments& o, int picture,
                          const TriMesh& mesh, const MaterialPictures& model) {
  if (picture >= 0)
    return decode_picture_input(tool, model.pictures[static_cast<std::size_t>(picture)],
                                o.max_pixels);
  const auto material = static_cast<std::size_t>(-1 - picture);
  const PicturedMaterial* found = find_material(model, mesh.material_names[material]);
  return make_plain(found == nullptr ? GlbMaterial() : found->look);
}

std::vector<TexturedRun> make_runs(const Tool& tool, const MeshshotArguments& o,
                                   const MaterialPictures& model, TriMesh& mesh) {
  if (mesh.materials.empty())
    throw InputError(o.mesh_file, "",
                     "its faces have no materials, by which one of the " +
                         std::to_string(count_colors(model)) + " pictures of " + o.texture +
                         " could be found");
  const std::vector<int> pictures = pictures_of(o, mesh, model);
  std::map<int, std::vector<bool>> faces;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::vector<bool>& own = faces[pictures[static_cast<std::size_t>(mesh.materials[t])]];
    own.resize(mesh.triangles.size(), false);
    own[t] = true;
  }
  std::vector<TexturedRun> runs;
  TriMesh ordered = keep_triangles(mesh, std::vector<bool>(mesh.triangles.size(), false));
  for (const auto& [picture, is_kept] : faces) {
    const TriMesh part = keep_triangles(mesh, is_kept);
    runs.push_back({texture_of_run(tool, o, picture, mesh, model), part.triangles.size()});
    append(ordered, part);
  }
  mesh = std::move(ordered);
  return runs;
}

// Whether some of the mesh's faces show none of the model's pictures, by their materials.
bool has_plain_faces(const TriMesh& mesh, const MaterialPictures& model) {
  if (mesh.materials.empty()) return false;
  bool has_plain = false;
  for (const std::string& name : mesh.material_names) {
    const PicturedMaterial* found = find_material(model, name);
    if (found == nullptr) return false;
    has_plain = has_plain || found->color < 0;
  }
  return has_plain;
}

// What of a model's materials is not drawn beside their pictures.
Remarks remark_looks(const MaterialPictures& model) {
  Remarks out = model.remarks;
  for (const PicturedMaterial& m : model.materials) {
    if (m.color < 0) continue;
    if (glm::dvec3(m.look.base_color_factor) != glm::dvec3(1))
      add_remark(&out, "colours that multiply a material's picture, not drawn");
    if (m.look.alpha_mode != "OPAQUE")
      add_remark(&out, "materials with alpha (" + m.look.alpha_mode + "), drawn opaque");
  }
  return out;
}

void remark_colours(const Tool& tool, const MeshshotArguments& o, const TriMesh& mesh) {
  const auto differs = [&](const glm::vec3& c) { return c != mesh.colors[0]; };
  if (o.texture.empty() || std::none_of(mesh.colors.begin(), mesh.colors.end(), differs)) return;
  tool.remark(o.mesh_file,
              {{"colours of vertices, not drawn beside a texture", mesh.colors.size()}});
}

// True where the texture is a model whose materials have several pictures, or some of them none.
bool read_several(const Tool& tool, MeshshotArguments& o, TriMesh& mesh, ShotTextures& out) {
  const bool has_slot = texture_file(o.texture) != std::filesystem::path(o.texture);
  if (has_slot || !has_material_pictures(o.texture)) return false;
  const MaterialPictures model = read_material_pictures(o.texture);
  tool.remark(o.texture, remark_looks(model));
  const std::size_t n = count_colors(model);
  if (n == 0 || (n == 1 && !has_plain_faces(mesh, model))) return false;
  if (!o.map_file.empty())
    throw InputError(o.texture, "",
                     "its materials have several pictures, or some none; an indexing map is for "
                     "one on all faces");
  o.texture_hash = model.hash;
  out.runs = make_runs(tool, o, model, mesh);
  return true;
}

}  // namespace

ShotTextures read_textures(const Tool& tool, MeshshotArguments& o, TriMesh& mesh) {
  ShotTextures out;
  if (o.texture.empty() && o.normal_map.empty()) return out;
  if (mesh.texcoords.empty())
    throw InputError(o.mesh_file, "",
                     std::string("has no texture coordinates, which --") +
                         (o.texture.empty() ? "normal-map" : "texture") + " needs");
  remark_colours(tool, o, mesh);
  if (!o.texture.empty() && !read_several(tool, o, mesh, out))
    out.color = read_texture_input(tool, o.texture, o.max_pixels, &o.texture_hash);
  if (!o.normal_map.empty())
    out.normal_map = read_texture_input(tool, o.normal_map, o.max_pixels, &o.normal_map_hash);
  if (!o.map_file.empty())
    out.index_map = read_index_map(o.map_file, &o.map_hash, nullptr, {o.max_pixels});
  return out;
}

}  // namespace viewcell
