#include "texadapt/pictures.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "common/picture_input.h"
#include "formats/material_pictures.h"

namespace viewcell {
namespace {

bool wants_normal_maps(const TexadaptArguments& a) {
  return a.format == LevelFormat::glb && !a.has_normal_map && !a.no_normal_map;
}

bool has_index_map(const TexadaptArguments& a) {
  return a.engine != AdaptEngine::rebake && a.options.texel != TexelKind::texture;
}

// What is asked for by name, over what the model has.
void take_asked_normal_map(const Tool& tool, const TexadaptArguments& a, ShownPicture& picture) {
  if (!a.has_normal_map) return;
  picture.has_normal_map = true;
  picture.normal_map = {};
  if (!a.normal_map.from.empty())
    picture.normal_map =
        read_texture_input(tool, a.normal_map.from, a.max_pixels, nullptr, &picture.normal_quality);
}

ShownPictures read_one(const Tool& tool, const TexadaptArguments& a) {
  ShownPictures out;
  ShownPicture& picture = out.pictures.emplace_back();
  picture.texture =
      read_texture_input(tool, a.texture, a.max_pixels, nullptr, &picture.texture_quality);
  take_asked_normal_map(tool, a, picture);
  return out;
}

// ---- by materials ----

class PictureChooser {
 public:
  PictureChooser(const Tool& tool, const TexadaptArguments& a, const ProgressiveRecord& record,
                 const MaterialPictures& model)
      : tool_(tool), a_(a), record_(record), model_(model) {}

  // Nothing where the model shows one picture, by materials of other names.
  ShownPictures choose() {
    const TriMesh& mesh = record_.attributes;
    const bool has_names = !mesh.materials.empty();
    const std::size_t n = has_names ? mesh.material_names.size() : 1;
    out_.looks.resize(n), out_.picture_of.assign(n, -1);
    for (std::size_t m = 0; m < n; ++m) {
      if (has_names && !is_used(m)) continue;
      const PicturedMaterial* found = has_names ? find(mesh.material_names[m]) : only_one();
      if (found == nullptr) return {};
      out_.looks[m] = found->look;
      out_.picture_of[m] = add_picture(*found);
      if (out_.picture_of[m] >= 0 && has_names) add_faces(m);
    }
    for (ShownPicture& picture : out_.pictures)
      if (std::find(picture.faces.begin(), picture.faces.end(), false) == picture.faces.end())
        picture.faces.clear(), picture.of.clear();
    if (out_.pictures.empty())
      throw InputError(a_.texture, "", "no material of the mesh has a colour texture");
    return std::move(out_);
  }

 private:
  bool is_used(std::size_t material) const {
    const auto& all = record_.attributes.materials;
    return std::find(all.begin(), all.end(), static_cast<std::int32_t>(material)) != all.end();
  }

  // Faces without a material are read as "default".
  const PicturedMaterial* find(const std::string& name) const {
    static const PicturedMaterial kNone{.name = "default", .look = {.name = "default"}};
    if (const PicturedMaterial* found = find_material(model_, name)) return found;
    if (name == "default") return &kNone;
    if (count_colors(model_) == 1) return nullptr;
    throw InputError(a_.pm, "", "its material '" + name + "' is none of " + a_.texture);
  }

  const PicturedMaterial* only_one() const {
    if (model_.materials.size() == 1) return &model_.materials[0];
    if (count_colors(model_) <= 1) return nullptr;
    throw InputError(a_.pm, "",
                     "its faces have no materials, by which pictures of " + a_.texture +
                         " could be found: build it from that model");
  }

  // The same for materials that show the same pictures.
  int add_picture(const PicturedMaterial& material) {
    const bool has_normals = material.normal >= 0 && wants_normal_maps(a_) && has_index_map(a_);
    if (material.color < 0 && !has_normals) return -1;
    const std::pair key(material.color, has_normals ? material.normal : -1);
    const auto [found, is_new] = ids_.try_emplace(key, static_cast<int>(out_.pictures.size()));
    if (!is_new) return found->second;
    ShownPicture& picture = out_.pictures.emplace_back();
    picture.has_normal_map = has_normals;
    if (has_normals) picture.normal_map = decode(key.second, picture.normal_quality);
    picture.has_texture = material.color >= 0;
    picture.texture = picture.has_texture
                          ? decode(key.first, picture.texture_quality)
                          : ImageRgba8(picture.normal_map.width_px, picture.normal_map.height_px,
                                       {255, 255, 255, 255});
    take_asked_normal_map(tool_, a_, picture);
    return found->second;
  }

  ImageRgba8 decode(int id, int& lossy_quality) const {
    return decode_picture_input(tool_, model_.pictures[static_cast<std::size_t>(id)], a_.max_pixels,
                                &lossy_quality);
  }

  void add_faces(std::size_t material) {
    const TriMesh& mesh = record_.attributes;
    ShownPicture& picture = out_.pictures[static_cast<std::size_t>(out_.picture_of[material])];
    picture.faces.resize(mesh.materials.size(), false);
    for (std::size_t f = 0; f < mesh.materials.size(); ++f)
      if (mesh.materials[f] == static_cast<std::int32_t>(material)) picture.faces[f] = true;
    picture.of += (picture.of.empty() ? "" : ", ") + mesh.material_names[material];
  }

  const Tool& tool_;
  const TexadaptArguments& a_;
  const ProgressiveRecord& record_;
  const MaterialPictures& model_;
  ShownPictures out_;
  std::map<std::pair<int, int>, int> ids_;
};

Remarks remark_left_out(const TexadaptArguments& a, const MaterialPictures& model) {
  Remarks remarks = model.remarks;
  const auto n = static_cast<std::size_t>(
      std::count_if(model.materials.begin(), model.materials.end(),
                    [](const PicturedMaterial& m) { return m.normal >= 0; }));
  if (wants_normal_maps(a) && !has_index_map(a))
    add_remark(&remarks, "normal maps, left out: --engine rebake and --texels texture make none",
               n);
  if (a.no_normal_map) add_remark(&remarks, "normal maps, left out", n);
  return remarks;
}

ShownPictures find_pictures(const Tool& tool, const TexadaptArguments& a,
                            const ProgressiveRecord& record) {
  const bool has_slot = texture_file(a.texture) != std::filesystem::path(a.texture);
  if (has_slot || !has_material_pictures(a.texture)) return read_one(tool, a);
  const MaterialPictures model = read_material_pictures(a.texture);
  ShownPictures out = PictureChooser(tool, a, record, model).choose();
  if (out.pictures.empty()) {
    out = read_one(tool, a);
    add_remark(&out.remarks,
               "materials of " + a.pm + " that are none of this model's, which get its one picture",
               record.attributes.material_names.size());
    return out;
  }
  if (a.format == LevelFormat::glb) out.remarks = remark_left_out(a, model);
  return out;
}

}  // namespace

bool ShownPictures::have_normal_maps() const {
  return std::any_of(pictures.begin(), pictures.end(),
                     [](const ShownPicture& p) { return p.has_normal_map; });
}

ShownPictures read_pictures(const Tool& tool, const TexadaptArguments& a,
                            const ProgressiveRecord& record) {
  ShownPictures out = find_pictures(tool, a, record);
  const bool has_lossy = std::any_of(
      out.pictures.begin(), out.pictures.end(),
      [](const ShownPicture& p) { return p.texture_quality > 0 || p.normal_quality > 0; });
  if (a.quality && !has_lossy)
    add_remark(&out.remarks,
               "pictures, none of which was JPEG or lossy WebP: --quality changes nothing",
               out.pictures.size());
  return out;
}

}  // namespace viewcell
