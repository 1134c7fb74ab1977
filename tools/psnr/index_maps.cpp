#include "psnr/index_maps.h"

#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "common/mesh_input.h"
#include "image/compare_index_maps.h"
#include "report/table.h"
#include "uv/chart_map.h"

namespace viewcell {
namespace {

Image<std::uint32_t> texels_inside(const Tool& tool, const std::string& mesh_file,
                                   const IndexMap& map) {
  const TriMesh mesh = read_mesh_input(tool, mesh_file);
  if (mesh.texcoords.empty())
    throw InputError(mesh_file, "", "has no texture coordinates, so no texel lies inside");
  return make_chart_map(mesh, find_charts(mesh), map.width_px, map.height_px);
}

std::pair<IndexMap, IndexMap> read_pair(const std::string& reference, const std::string& tested) {
  const auto size = [](const IndexMap& map) {
    return std::to_string(map.width_px) + " x " + std::to_string(map.height_px);
  };
  std::pair<IndexMap, IndexMap> maps{read_index_map(reference), read_index_map(tested)};
  if (size(maps.first) != size(maps.second))
    throw InputError(
        tested, "",
        "is " + size(maps.second) + " texels, but " + reference + " is " + size(maps.first));
  return maps;
}

}  // namespace

void compare_index_map_files(const Tool& tool, const std::string& reference,
                             const std::string& tested, const std::string& inside) {
  const auto [a, b] = read_pair(reference, tested);
  CompareIndexMapsOptions options;
  if (!inside.empty()) options.counted = texels_inside(tool, inside, a);
  const IndexMapDistance distance = compare_index_maps(a, b, options);
  if (distance.n_texels == 0) throw InputError(inside, "", "no texel lies inside its charts");
  const CommonOptions& common = tool.common();
  const std::string table_file = common.output.empty() ? "-" : common.output;
  if (table_file != "-" || common.json_file != "-")
    write_file(table_file, format_table({{"map", "RMS texels", "max", "within 1", "texels"},
                                         {tested, format_fixed(distance.rms_texels, 4, "-"),
                                          format_fixed(distance.max_texels, 3, "-"),
                                          format_fixed(distance.share_within, 6, "-"),
                                          std::to_string(distance.n_texels)}}));
  tool.report({{"rms_texels", distance.rms_texels},
               {"max_texels", distance.max_texels},
               {"share_within_texel", distance.share_within},
               {"texels", distance.n_texels},
               {"width_px", a.width_px},
               {"height_px", a.height_px}});
}

}  // namespace viewcell
