#include <map>

#include "base/error.h"
#include "formats/gltf_materials.h"
#include "formats/model_pictures.h"

namespace viewcell {
namespace {

class GltfPictureReader {
 public:
  GltfPictureReader(std::string_view bytes, const std::filesystem::path& file, PictureFaults faults)
      : gltf_(parse_gltf_file(bytes, file)),
        names_(name_materials(gltf_.root())),
        faults_(faults) {}

  MaterialPictures read() {
    for (const std::int64_t id : used_materials(gltf_.root())) {
      const auto at = static_cast<std::size_t>(id);
      const JsonCursor material = gltf_.root().at("materials").at(at);
      add_material(material, names_.at(at));
    }
    return std::move(out_);
  }

 private:
  void add_material(const JsonCursor& material, const std::string& name) {
    PicturedMaterial m;
    m.look = read_look(material);
    m.name = name;
    if (material.has("name")) m.look.name = material.at("name").string();
    m.color = picture_of(material, GltfSlot::base_color, m.look.color_sampler);
    m.normal = picture_of(material, GltfSlot::normal, m.look.normal_sampler);
    for (const GltfSlot slot :
         {GltfSlot::emissive, GltfSlot::occlusion, GltfSlot::metallic_roughness})
      if (texture_of(material, slot))
        add_remark(&out_.remarks,
                   std::string("textures in the slot ") + name_of(slot) + ", left out");
    if (material.has("extensions") && material.at("extensions").value().is_object())
      for (const auto& [extension, ignored] : material.at("extensions").value().items())
        add_remark(&out_.remarks, extension + " of materials, left out");
    out_.materials.push_back(m);
  }

  // Metal and roughness multiply a texture; without it they would mean another thing.
  GlbMaterial read_look(const JsonCursor& material) const {
    GlbMaterial look;
    look.base_color_factor = base_color_factor(material);
    const bool has_metal = texture_of(material, GltfSlot::metallic_roughness).has_value();
    if (material.has("pbrMetallicRoughness") && !has_metal) {
      const JsonCursor pbr = material.at("pbrMetallicRoughness");
      look.metallic = pbr.has("metallicFactor") ? pbr.at("metallicFactor").number(0, 1) : 1;
      look.roughness = pbr.has("roughnessFactor") ? pbr.at("roughnessFactor").number(0, 1) : 1;
    }
    if (material.has("normalTexture") && material.at("normalTexture").has("scale"))
      look.normal_scale = material.at("normalTexture").at("scale").number(-1e6, 1e6);
    if (material.has("emissiveFactor") && !texture_of(material, GltfSlot::emissive)) {
      const std::vector<double> e = material.at("emissiveFactor").numbers(3, 0, 1e6);
      look.emissive = {e[0], e[1], e[2]};
    }
    if (material.has("alphaMode")) look.alpha_mode = read_alpha_mode(material.at("alphaMode"));
    if (material.has("alphaCutoff")) look.alpha_cutoff = material.at("alphaCutoff").number(0, 1e6);
    look.is_double_sided = material.has("doubleSided") && material.at("doubleSided").boolean();
    return look;
  }

  static std::string read_alpha_mode(const JsonCursor& mode) {
    const std::string out = mode.string();
    if (out != "OPAQUE" && out != "MASK" && out != "BLEND")
      mode.fail("is '" + out + "', not OPAQUE, MASK or BLEND");
    return out;
  }

  int picture_of(const JsonCursor& material, GltfSlot slot, GlbSampler& sampler) {
    const std::optional<GltfTextureUse> use = texture_of(material, slot);
    if (!use) return -1;
    if (use->texcoords != leading_texture(material)->texcoords) {
      add_remark(&out_.remarks, std::string("textures in the slot ") + name_of(slot) +
                                    " with texture coordinates of their own, left out");
      return -1;
    }
    if (slot == GltfSlot::normal && !has_readable_image(gltf_.root(), use->texture)) {
      add_remark(&out_.remarks, "normal maps that are no PNG, JPEG or WebP, left out");
      return -1;
    }
    sampler = sampler_of(gltf_.root(), use->texture);
    const std::int64_t image = image_of_texture(gltf_.root(), use->texture);
    if (const auto found = ids_.find(image); found != ids_.end()) return found->second;
    return or_left_out(faults_, out_.remarks, [&] {
      out_.pictures.push_back({read_image_bytes(gltf_, image),
                               gltf_.file.string() + ": images[" + std::to_string(image) + "]"});
      return ids_[image] = static_cast<int>(out_.pictures.size()) - 1;
    });
  }

  GltfFile gltf_;
  std::vector<std::string> names_;
  PictureFaults faults_;
  std::map<std::int64_t, int> ids_;
  MaterialPictures out_;
};

}  // namespace

MaterialPictures read_gltf_pictures(std::string_view bytes, const std::filesystem::path& file,
                                    PictureFaults faults) {
  return GltfPictureReader(bytes, file, faults).read();
}

}  // namespace viewcell
