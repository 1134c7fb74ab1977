#include "texadapt/level_writer.h"

#include <filesystem>

#include "base/version.h"
#include "formats/mesh_file.h"
#include "formats/write_glb.h"
#include "image/io.h"

namespace viewcell {
namespace {

std::string format_comment() {
  return std::string("made by texadapt ") + version();
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
  Remarks remarks;
  if (a_.format == LevelFormat::map)
    write_index_map(output, *map, map_label(in_.hash, mesh.triangles.size()));
  else if (a_.format == LevelFormat::png)
    write_png(output, bake(in_.texture));
  else
    write_glb(output, mesh,
              {encode_png(bake(in_.texture)), normal_map ? encode_png(*normal_map) : "",
               format_comment()},
              &remarks);
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
    write_png(file, *normal_map);
  for (std::size_t i = 0; i < in_.further.size(); ++i)
    write_png(a_.name_at(a_.further[i].to, level), bake(in_.further[i]));
}

}  // namespace viewcell
