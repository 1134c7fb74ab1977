#include "formats/material_pictures.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "formats/model_pictures.h"

namespace viewcell {

std::string lower_ending_of(const std::filesystem::path& file) {
  std::string out = file.extension().string();
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

const PicturedMaterial* find_material(const MaterialPictures& model, const std::string& name) {
  for (const PicturedMaterial& m : model.materials)
    if (m.name == name) return &m;
  return nullptr;
}

std::size_t count_colors(const MaterialPictures& model) {
  std::set<int> colors;
  for (const PicturedMaterial& m : model.materials)
    if (m.color >= 0) colors.insert(m.color);
  return colors.size();
}

int or_left_out(PictureFaults faults, Remarks& remarks, const std::function<int()>& picture) {
  if (faults == PictureFaults::refuse) return picture();
  try {
    return picture();
  } catch (const InputError& error) {
    add_remark(&remarks, std::string(error.what()) + ": left out");
    return -1;
  }
}

bool has_material_pictures(const std::filesystem::path& file) {
  const std::string ending = lower_ending_of(file);
  return ending == ".glb" || ending == ".gltf" || ending == ".obj";
}

MaterialPictures read_material_pictures(const std::filesystem::path& file, PictureFaults faults) {
  const std::string bytes = read_file(file);
  MaterialPictures out = lower_ending_of(file) == ".obj" ? read_obj_pictures(bytes, file, faults)
                                                         : read_gltf_pictures(bytes, file, faults);
  out.hash = hash_hex(bytes);
  return out;
}

}  // namespace viewcell
