#include "texadapt/level_writer.h"

#include <array>
#include <filesystem>

#include "base/version.h"
#include "formats/mesh_file.h"
#include "formats/write_glb.h"
#include "image/io.h"
#include "image/jpeg.h"
#include "image/shrink.h"

namespace viewcell {
namespace {

std::string format_comment() {
  return std::string("made by texadapt ") + version();
}

// Whether vertices have colours only because read_mesh gives them those of their materials.
bool are_factors(const TriMesh& mesh, const std::vector<GlbMaterial>& looks) {
  constexpr float kRounding = 1e-4f;
  if (mesh.colors.empty() || looks.empty()) return false;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto m = mesh.materials.empty() ? 0 : static_cast<std::size_t>(mesh.materials[t]);
    const glm::vec3 factor(looks[m].base_color_factor);
    for (const std::uint32_t v : mesh.triangles[t])
      if (glm::any(glm::greaterThan(glm::abs(mesh.colors[v] - factor), glm::vec3(kRounding))))
        return false;
  }
  return true;
}

}  // namespace

std::string map_label(const std::string& hash, std::size_t n_faces) {
  return kLabelStart + hash + ", level of " + std::to_string(n_faces) + " faces";
}

// Viewers find the texture of a PLY by such a comment, relative to it.
std::vector<std::string> LevelWriter::comments_of(const std::string& file,
                                                  std::size_t level) const {
  namespace fs = std::filesystem;
  std::vector<std::string> out{format_comment()};
  const std::string output = a_.name_at(tool_.common().output, level);
  if (a_.format == LevelFormat::png && output != "-")
    out.push_back("TextureFile " +
                  fs::path(output).lexically_proximate(fs::path(file).parent_path()).string());
  return out;
}

void LevelWriter::write_output(std::size_t level, const TriMesh& mesh, const IndexMap* map,
                               const ImageRgba8* normal_map, const Bake& bake) const {
  const std::string output = a_.name_at(tool_.common().output, level);
  const ShownPicture& picture = in_.shown.pictures[0];
  if (a_.format == LevelFormat::map)
    write_index_map(output, *map, map_label(in_.hash, mesh.triangles.size()));
  else if (a_.format == LevelFormat::png)
    write_picture(output, bake(picture.texture), PixelKind::color);
  else
    write_model(level, mesh, std::array{encode(picture, bake(picture.texture), normal_map)});
}

void LevelWriter::write_picture(const std::string& file, const ImageRgba8& image,
                                PixelKind kind) const {
  if (a_.texture_side == 0) return write_png(file, image);
  write_png(file, shrink_to_side(image, a_.texture_side, kind, tool_.common().n_threads));
}

EncodedPicture LevelWriter::encode(const ShownPicture& picture, const ImageRgba8& color,
                                   const ImageRgba8* normal_map) const {
  const auto encode_one = [&](const ImageRgba8& image, PixelKind kind, int lossy_quality) {
    const ImageRgba8 small = a_.texture_side == 0 ? image
                                                  : shrink_to_side(image, a_.texture_side, kind,
                                                                   tool_.common().n_threads);
    if (lossy_quality > 0)
      return encode_jpeg(small, {.quality = a_.quality.value_or(lossy_quality),
                                 .halves_hues = kind == PixelKind::color});
    return encode_png(small, is_opaque(small) ? PngAlpha::drop : PngAlpha::keep);
  };
  EncodedPicture out;
  if (picture.has_texture) out.color = encode_one(color, PixelKind::color, picture.texture_quality);
  if (normal_map) out.normal_map = encode_one(*normal_map, PixelKind::data, picture.normal_quality);
  return out;
}

void LevelWriter::write_model(std::size_t level, const TriMesh& mesh,
                              std::span<const EncodedPicture> pictures) const {
  GlbOptions options{.base_color = "", .normal_map = "", .generator = format_comment()};
  options.materials = in_.shown.looks;
  for (std::size_t m = 0; m < options.materials.size(); ++m) {
    if (in_.shown.picture_of[m] < 0) continue;
    const EncodedPicture& picture = pictures[static_cast<std::size_t>(in_.shown.picture_of[m])];
    options.materials[m].base_color = picture.color;
    options.materials[m].normal_map = picture.normal_map;
  }
  if (options.materials.empty())
    options.base_color = pictures[0].color, options.normal_map = pictures[0].normal_map;
  const std::string output = a_.name_at(tool_.common().output, level);
  Remarks remarks;
  if (are_factors(mesh, options.materials)) {
    TriMesh bare = mesh;
    bare.colors.clear();
    write_glb(output, bare, options, &remarks);
  } else {
    write_glb(output, mesh, options, &remarks);
  }
  tool_.remark(output, remarks);
}

void LevelWriter::write_mesh(std::size_t level, const TriMesh& mesh) const {
  const std::string file = a_.name_at(a_.mesh, level);
  Remarks remarks;
  if (file.ends_with(".obj"))
    write_obj(file, mesh, {{format_comment()}, "", ""});
  else if (!file.empty())
    write_ply(file, mesh, comments_of(file, level), &remarks);
  tool_.remark(file, remarks);
}

void LevelWriter::write(std::size_t level, const TriMesh& mesh, const IndexMap* map,
                        const ImageRgba8* normal_map, const Bake& bake) const {
  write_output(level, mesh, map, normal_map, bake);
  write_mesh(level, mesh);
  if (!a_.index_map.empty())
    write_index_map(a_.name_at(a_.index_map, level), *map,
                    map_label(in_.hash, mesh.triangles.size()));
  if (const std::string file = a_.name_at(a_.normal_map.to, level); !file.empty())
    write_picture(file, *normal_map, PixelKind::data);
  for (std::size_t i = 0; i < in_.further.size(); ++i)
    write_picture(a_.name_at(a_.further[i].to, level), bake(in_.further[i]), PixelKind::color);
}

}  // namespace viewcell
