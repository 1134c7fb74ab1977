// One run of the player along a path: every mode timed, then compared with the reference.
#pragma once

#include <filesystem>
#include <vector>

#include "base/parallel.h"
#include "play/player.h"
#include "play/timeline.h"
#include "report/contact_sheet.h"

namespace viewcell {

struct SessionOptions {
  std::vector<Mode> modes;
  Mode reference = Mode::frustum;
  std::size_t n_frames = 120;
  /// Modes take turns after so many frames. A mode's frames follow its own, as in play, with caches
  /// that are warm for it; a drift of the machine still meets all modes alike.
  std::size_t turn_frames = 24;
  std::filesystem::path save;  ///< folder of frames, MODE/frame-00012.png; empty: none
  std::size_t save_every = 1;
  bool save_alpha = false;        ///< as image/image.h has it; otherwise saved frames are opaque
  std::size_t n_sheet_rows = 4;   ///< frames on the contact sheet
  std::size_t quality_every = 1;  ///< compare every K-th frame
  bool with_quality = true;       ///< compare pictures (some seconds a hundred frames and mode)
};

struct Session {
  Timeline timeline;
  ImageRgba8 contact_sheet;  ///< reference | hybrid | difference x 8 | kinds; empty without hybrid
};

/// First every frame is drawn in every mode, timed, the modes taking turns, from a bundle of which
/// one cell is loaded; then the frames are drawn again to be read back, compared and saved. Throws
/// InputError when a mode draws the hybrid and no eye is in a cell that the bundle holds.
Session run_session(Player& player, const Bundle& bundle, const CameraPath& path,
                    const SessionOptions& options, const Progress& progress = {});

}  // namespace viewcell
