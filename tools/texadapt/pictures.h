// The pictures that the faces of a progressive mesh show: one on all of them, or those of a model's
// materials.
#pragma once

#include <string>
#include <vector>

#include "base/remarks.h"
#include "formats/glb_material.h"
#include "image/image.h"
#include "pm/progressive_mesh.h"
#include "texadapt/arguments.h"

namespace viewcell {

struct ShownPicture {
  ImageRgba8 texture;  ///< white where there is a normal map alone
  bool has_texture = true;
  bool stays = false;           ///< it repeats: levels show it as it is
  ImageRgba8 normal_map;        ///< empty: none, or what the finest mesh's shading makes
  bool has_normal_map = false;  ///< levels get one
  /// Of JPEG, where they were stored so that a little is lost, and without alpha (decode_texture);
  /// 0: written as PNG.
  int texture_quality = 0, normal_quality = 0;
  std::vector<bool> faces;  ///< of the record, that show it; empty: all
  std::string of;           ///< of which materials, for people; empty: all
};

struct ShownPictures {
  std::vector<ShownPicture> pictures;
  /// By the record's materials (one where faces have none): what a GLB says of them, and which of
  /// the pictures they show, -1: none. Empty: one material, white.
  std::vector<GlbMaterial> looks;
  std::vector<int> picture_of;
  Remarks remarks;  ///< what of the materials is left out

  bool have_normal_maps() const;
};

/// The picture that --help's TEXTURE names; of a GLB, glTF or OBJ those of its materials, found by
/// the names that the record's faces have. What of a material is left out is remarked on where a
/// GLB is written. Throws InputError for a material of the record that the model has not, and for
/// faces none of which shows a picture.
ShownPictures read_pictures(const Tool& tool, const TexadaptArguments& arguments,
                            const ProgressiveRecord& record);

}  // namespace viewcell
