// What GL draws to adapt a texture: packs of adaptations as vertices.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "adapt/adaptation.h"
#include "adapt/texel_owners.h"
#include "image/texel_spans.h"

namespace viewcell {

// Positions are in texels, centres at whole numbers, rows up as in GL.

/// Of triangles that need no owners. Where `from` is interpolated, a texel at `to` is sampled
/// there. Where it is not, from.x says what becomes of the texel: 0 stays, 1 gets its own texture
/// coordinates (values alone); or the name of the chart that no longer owns it (with owners).
struct AdaptVertex {
  glm::vec2 to, from;
};

/// Of triangles that look up who owns the texels they read and write. The source is
/// origin + clamp(local.x, lo.x, hi.x) * along + clamp(local.y, lo.y, hi.y) * out, where out is
/// (along.y, -along.x) * side.
struct OwnedVertex {
  glm::vec2 to, local;
  glm::vec2 origin, along;
  glm::vec2 lo, hi;
  float side = 1;
  std::uint32_t owner = 0;  ///< as it will be; 0: as it is
  std::uint32_t name = 0;   ///< whose texels are sampled
  /// Of the star whose texels the chart may take over, in star_corners; bit 31 of n_corners: the
  /// texels get their own texture coordinates.
  std::uint32_t first_corner = 0, n_corners = 0;
};
static_assert(sizeof(AdaptVertex) == 16 && sizeof(OwnedVertex) == 68);
inline constexpr std::uint32_t kOwnTexcoordsBit = 1u << 31;

struct DrawRange {
  std::size_t first = 0, n = 0;
};

/// A part of the texture.
struct TexelBox {
  int x = 0, y = 0, width_px = 0, height_px = 0;
  bool has_owners = false;
};

/// Draws of one pack, in this order, after the boxes that are copied without drawing; the first
/// three of indices, the last of owned vertices.
struct PackDraws {
  DrawRange copy_owned;   ///< values and owners of the pack before; texels that lose their owner
  DrawRange copy_values;  ///< values of the pack before; texels set to their own coordinates
  DrawRange sample;
  DrawRange sample_owned;
  DrawRange boxes;  ///< of the pack before: values, and owners where they have any
};

/// Some packs, to be uploaded at once.
struct AdaptBatch {
  std::vector<AdaptVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<OwnedVertex> owned;
  std::vector<glm::vec2> star_corners;  ///< three a triangle
  std::vector<TexelBox> boxes;
  std::vector<PackDraws> packs;

  std::size_t n_bytes() const;
};

/// Lays out packs one after another. A pack reads one texture, which holds all that came before it,
/// and writes another, in which what the pack before it wrote is still missing and copied first.
class AdaptBatchBuilder {
 public:
  /// owners: rows up. has_original: texels may be set to their own texture coordinates (indexing
  /// maps). copies_boxes: what a pack wrote is copied as boxes, unless it fills too little of its
  /// box; false: drawn.
  AdaptBatchBuilder(const AdaptationLog& log, const Image<std::uint16_t>& owners, bool has_original,
                    bool copies_boxes);
  /// collapses: of one pack. is_collapse: false for splits.
  void add_pack(std::span<const std::uint32_t> collapses, bool is_collapse);
  AdaptBatch take();  ///< the packs since the last time
  std::size_t n_bytes() const { return batch_.n_bytes(); }

 private:
  struct Outlines {  // convex
    std::vector<glm::vec2> corners;
    std::vector<std::size_t> n_corners;
  };
  struct Scratch {
    std::vector<glm::vec2> from, to;
    std::vector<std::uint32_t> sampled, own_texcoords, released;
  };
  void read_points(const Adaptation& adaptation, bool is_collapse);
  TexelTriangle corners(const std::vector<glm::vec2>& points, const AdaptationTriangle& t) const;
  bool is_own_texcoords(const AdaptationTriangle& t, bool is_collapse) const;
  void add_plain(const Adaptation& adaptation, bool is_collapse);
  void add_triangles(const Adaptation& adaptation, bool is_collapse, bool own_texcoords);
  void add_owned(const Adaptation& adaptation, bool is_collapse, bool has_border);
  void add_release(const Adaptation& adaptation);
  void add_gutter(const TexelTriangle& from, const TexelTriangle& to, std::size_t edge,
                  OwnedVertex vertex);
  void add_written(const Adaptation& adaptation, Outlines& outlines);
  void add_outline(std::vector<glm::vec2>& points, Outlines& outlines);
  void add_border_written();
  void add_copied_box(const glm::vec2& lo, const glm::vec2& hi, bool has_owners);
  void add_copies(Outlines& outlines, std::vector<std::uint32_t>& indices);
  DrawRange append(const std::vector<std::uint32_t>& indices);

  const AdaptationLog& log_;
  int width_px_, height_px_;
  bool has_original_, copies_boxes_;
  OwnerTiles tiles_;
  AdaptBatch batch_;
  Scratch scratch_;
  Outlines written_, written_owned_;  // by the last pack
  std::vector<TexelBox> written_boxes_;
};

}  // namespace viewcell
