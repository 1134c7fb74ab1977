#include "play/arguments.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "common/scene_inputs.h"

namespace viewcell {
namespace {

std::vector<Mode> parse_modes(const std::string& list) {
  std::vector<Mode> modes;
  std::string item;
  for (const char c : list + ",") {
    if (c != ',') {
      item += c;
      continue;
    }
    const Mode mode = parse_mode(item);
    if (std::find(modes.begin(), modes.end(), mode) != modes.end())
      throw UsageError("--modes: '" + item + "' is named twice");
    modes.push_back(mode);
    item.clear();
  }
  return modes;
}

PlayerOptions make_player_options(const Tool& tool, const PlayArguments& o) {
  PlayerOptions player;
  char rest = 0;
  if (std::sscanf(o.size.c_str(), "%dx%d%c", &player.width_px, &player.height_px, &rest) != 2 ||
      std::min(player.width_px, player.height_px) < 16 ||
      std::max(player.width_px, player.height_px) > 8192)
    throw UsageError("--size: '" + o.size + "' is not WIDTHxHEIGHT within 16 to 8192");
  player.fov_y_deg = o.fov_y_deg;
  player.engine = parse_gl_engine(o.gl);
  player.n_threads = tool.common().n_threads;
  player.residency.pool_texels = static_cast<std::uint32_t>(o.texture_mb) << 18;
  player.residency.prefetch = !o.no_prefetch;
  player.with_lod = row_of(o.session.reference).draws_levels;
  for (const Mode mode : o.session.modes) {
    player.with_lod |= row_of(mode).draws_levels;
    player.with_raycast |= row_of(mode).engine == ModeEngine::rays;
  }
  return player;
}

}  // namespace

void declare_arguments(Tool& tool, PlayArguments& o) {
  tool.add_mesh_limit(tool);
  tool.add_option("bundle", &o.bundle, "folder of the bundle")
      .required()
      .reads("the bundle that is read", kBundleFiles);
  tool.add_option("--path", &o.path_file, "path.json").required().reads("the path that is read");
  tool.add_option("--modes", &o.modes, "of " + list_modes()).show_default();
  tool.add_option("--reference", &o.reference, "mode that pictures are compared with")
      .show_default();
  tool.add_option("--frames", &o.session.n_frames, "frames over the whole path")
      .show_default()
      .check(in_range(1, 100000));
  tool.add_option("--turn", &o.session.turn_frames,
                  "frames of one mode before the next has its turn")
      .show_default()
      .check(in_range(1, 100000));
  tool.add_option("--size", &o.size, "WIDTHxHEIGHT in px").show_default();
  tool.add_option("--fov", &o.fov_y_deg,
                  "vertical field of view in degrees (default: the path's, which is 60 where it "
                  "says nothing)")
      .check(within(kLeastFovYDeg, kMostFovYDeg));
  tool.add_option("--save", &o.session.save, "folder to write frames to, as PNG")
      .writes({"*/frame-*.png"});
  tool.add_flag("--save-alpha", &o.session.save_alpha,
                "saved frames keep in their alpha where objects are, which psnr's covered figures "
                "go by; viewers then show ground and sky as transparent")
      .needs("--save");
  tool.add_option("--every", &o.session.save_every, "save every K-th frame")
      .show_default()
      .needs("--save")
      .check(in_range(1, 100000));
  tool.add_option("--quality-every", &o.session.quality_every, "compare every K-th frame")
      .show_default()
      .excludes("--no-quality")
      .check(in_range(1, 100000));
  tool.add_option("--stats", &o.stats_file, "write statistics as JSON (-: stdout)").writes();
  tool.add_option("--table", &o.table_file, "write the table of modes as Markdown (-: stdout)")
      .writes();
  tool.add_option("--plots", &o.plots_folder, "folder to write plots to, as SVG").writes({"*.svg"});
  tool.add_option("--sheet", &o.sheet_file,
                  "write a contact sheet of the frames in which hybrid is worst, as PNG")
      .writes()
      .excludes("--no-quality");
  tool.add_option("--sheet-rows", &o.session.n_sheet_rows, "frames on it").show_default();
  tool.add_option("--gl", &o.gl, "osmesa | egl").show_default();
  tool.add_option("--texture-memory", &o.texture_mb, "MB of GL memory for textures")
      .show_default()
      .check(in_range(1, 512));
  tool.add_flag("--no-prefetch", &o.no_prefetch, "load cells only when they are entered");
  tool.add_flag("--no-quality", &o.no_quality, "only measure times");
}

PlayerOptions finish_arguments(const Tool& tool, PlayArguments& o) {
  o.session.modes = parse_modes(o.modes);
  o.session.reference = parse_mode(o.reference);
  o.session.with_quality = !o.no_quality;
  const PlayerOptions player = make_player_options(tool, o);
  if (row_of(o.session.reference).engine == ModeEngine::rays && !player.with_raycast)
    throw UsageError("--reference: " + o.reference + " must be among --modes");
  const auto& modes = o.session.modes;
  if (!o.sheet_file.empty() && std::find(modes.begin(), modes.end(), Mode::hybrid) == modes.end())
    throw UsageError("--sheet: hybrid must be among --modes");
  return player;
}

}  // namespace viewcell
