// The files of a level.
#pragma once

#include <functional>
#include <span>

#include "image/index_map.h"
#include "image/shrink.h"
#include "texadapt/inputs.h"

namespace viewcell {

/// What an indexing map is of, as written into its file: the hash of a progressive mesh, a level.
inline constexpr const char* kLabelStart = "indexing map of mesh ";
std::string map_label(const std::string& hash, std::size_t n_faces);

/// A picture of a level as a GLB holds it.
struct EncodedPicture {
  std::string color, normal_map;  ///< empty: none
};

/// Keeps what it is made of by reference.
class LevelWriter {
 public:
  /// What a level shows of a texture.
  using Bake = std::function<ImageRgba8(const ImageRgba8& texture)>;

  LevelWriter(const Tool& tool, const TexadaptArguments& arguments, const TexadaptInputs& inputs)
      : tool_(tool), a_(arguments), in_(inputs) {}

  /// The textures of the level of so many faces, its mesh and its maps, each where it is asked for:
  /// of the one picture that there is. map, normal_map: null where there is none.
  void write(std::size_t level, const TriMesh& mesh, const IndexMap* map,
             const ImageRgba8* normal_map, const Bake& bake) const;

  /// As PNG, or, where the picture was stored so, as JPEG; both not larger than was asked for.
  EncodedPicture encode(const ShownPicture& picture, const ImageRgba8& color,
                        const ImageRgba8* normal_map) const;
  /// A GLB of all pictures.
  void write_model(std::size_t level, const TriMesh& mesh,
                   std::span<const EncodedPicture> pictures) const;

 private:
  void write_output(std::size_t level, const TriMesh& mesh, const IndexMap* map,
                    const ImageRgba8* normal_map, const Bake& bake) const;
  void write_mesh(std::size_t level, const TriMesh& mesh) const;
  void write_picture(const std::string& file, const ImageRgba8& image, PixelKind kind) const;
  std::vector<std::string> comments_of(const std::string& file, std::size_t level) const;

  const Tool& tool_;
  const TexadaptArguments& a_;
  const TexadaptInputs& in_;
};

}  // namespace viewcell
