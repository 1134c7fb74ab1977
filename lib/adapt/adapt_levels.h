// A texture at one level of a progressive mesh after another.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "adapt/texture_adapt.h"
#include "gl/objects.h"
#include "image/index_map.h"
#include "pm/progressive_mesh.h"

namespace viewcell {

/// What a texel of an indexing map is while it is adapted; texture: the texture itself is adapted,
/// with no indexing map.
enum class TexelKind { float32, float16, unorm16, unorm8, texture };
/// "float", "half", "16", "8" or "texture". Throws UsageError.
TexelKind parse_texel_kind(const std::string& name);

struct AdaptLevelsOptions {
  int width_px = 0, height_px = 0;  ///< of the map; 0: the texture's
  TexelKind texel = TexelKind::float32;
  AdaptOptions adapt;
  const Gl* gl = nullptr;  ///< adapt by drawing; counts have no texels then
  /// A map to start from, and the faces of the level that it is of (the finest of at most so many);
  /// without: the identity, at the finest level. Not for TexelKind::texture.
  std::optional<IndexMap> start;
  std::size_t start_faces = 0;
};

/// Keeps the log and the texture by reference.
class AdaptLevels {
 public:
  /// record: of the log. Throws UsageError for a start whose size is not the map's.
  AdaptLevels(const ProgressiveRecord& record, const AdaptationLog& log, const ImageRgba8& texture,
              const AdaptLevelsOptions& options = {});
  ~AdaptLevels();

  /// Coarsens or refines to the finest level of at most n faces, or the base. Waits for what GL
  /// draws.
  void set_faces(std::size_t n);

  const ProgressiveMesh& mesh() const { return mesh_; }
  /// Collapses made from the finest level on.
  std::size_t n_collapsed() const { return mesh_.n_splits() - mesh_.level(); }
  const AdaptCounts& counts() const;
  const LevelCharts& finest() const { return finest_; }
  LevelCharts charts() const { return make_level_charts(mesh_, log_); }
  /// Not for TexelKind::texture.
  IndexMap map() const;
  /// The same, moved out: frees the adapter, so set_faces() may not be called any more.
  IndexMap take_map();
  /// The texture, or another that has the same texture coordinates, for this level.
  ImageRgba8 bake() const;
  ImageRgba8 bake(const ImageRgba8& texture) const { return bake(texture, map()); }
  /// The same with the map() that is at hand, which may be large.
  ImageRgba8 bake(const ImageRgba8& texture, const IndexMap& map) const;

 private:
  class Adapter;
  template <typename Texel, typename Engine>
  class AdapterOf;

  const AdaptationLog& log_;
  const ImageRgba8& texture_;
  AdaptLevelsOptions options_;
  ProgressiveMesh mesh_;
  LevelCharts finest_;
  std::unique_ptr<Adapter> adapter_;
};

}  // namespace viewcell
