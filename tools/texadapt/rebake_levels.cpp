#include "adapt/rebake.h"
#include "common/stopwatch.h"
#include "mesh/subset.h"
#include "texadapt/level_writer.h"
#include "texadapt/levels.h"

namespace viewcell {
namespace {

// The triangles of a level (all faces that it has) that show a picture.
TriMesh part_of(const TriMesh& mesh, const ProgressiveMesh& level, const std::vector<bool>& faces) {
  if (faces.empty()) return mesh;
  std::vector<bool> is_kept;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (level.has_face(f)) is_kept.push_back(faces[f]);
  return keep_triangles(mesh, is_kept);
}

class Rebaker {
 public:
  Rebaker(const Tool& tool, const TexadaptArguments& a, const TexadaptInputs& in)
      : tool_(tool), a_(a), in_(in), finest_(make_finest(in.record)) {}

  ImageRgba8 bake(const ProgressiveMesh& level, const TriMesh& mesh, const ShownPicture& picture,
                  const ImageRgba8& texture) const {
    const TriMesh coarse = part_of(mesh, level, picture.faces);
    if (picture.stays || coarse.triangles.empty()) return texture;
    return rebake_texture(coarse, part_of(in_.finest, finest_, picture.faces), texture,
                          {.width_px = a_.options.width_px,
                           .height_px = a_.options.height_px,
                           .n_threads = tool_.common().n_threads,
                           .progress = tool_.progress("rows")});
  }

 private:
  const Tool& tool_;
  const TexadaptArguments& a_;
  const TexadaptInputs& in_;
  ProgressiveMesh finest_;
};

}  // namespace

Json rebake_levels(const Tool& tool, const TexadaptArguments& a, const TexadaptInputs& in) {
  const LevelWriter writer(tool, a, in);
  const Rebaker rebaker(tool, a, in);
  ProgressiveMesh mesh = make_finest(in.record);
  Json rows = Json::array();
  Stopwatch watch;
  double bake_s = 0;
  for (const std::size_t level : a.levels) {
    mesh.set_faces(level);
    const TriMesh coarse = mesh.extract();
    watch.lap_s();
    const auto bake = [&](const ShownPicture& picture, const ImageRgba8& texture) {
      return rebaker.bake(mesh, coarse, picture, texture);
    };
    std::vector<EncodedPicture> encoded;
    if (in.shown.pictures.size() == 1)
      writer.write(level, coarse, nullptr, nullptr,
                   [&](const ImageRgba8& texture) { return bake(in.shown.pictures[0], texture); });
    else
      for (const ShownPicture& picture : in.shown.pictures)
        encoded.push_back(writer.encode(picture, bake(picture, picture.texture), nullptr));
    if (!encoded.empty()) writer.write_model(level, coarse, encoded);
    bake_s += watch.lap_s();
    rows.push_back({{"faces", mesh.n_faces()}});
  }
  return {{"faces", rows.back()["faces"]}, {"levels", rows}, {"timing", {{"bake_s", bake_s}}}};
}

}  // namespace viewcell
