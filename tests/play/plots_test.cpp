#include "play/plots.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/file.h"
#include "common/temporary_folder.h"

namespace viewcell {
namespace {

PictureQuality at_db(double db) {
  return {db, db, 1, 1, 10, 0};
}

// So many frames, of which each k-th was compared; in the hybrid one shows no triangle.
Timeline compared_every(std::size_t k, std::size_t n_frames) {
  Timeline t;
  t.reference = Mode::frustum;
  t.modes = {{Mode::frustum, {}}, {Mode::hybrid, {}}};
  for (std::size_t i = 0; i < n_frames; ++i) {
    FrameInfo info;
    info.time_s = static_cast<double>(i);
    FrameRecord frame{1, 1000, 1, 0, {}}, fast{0.1, i == 2 ? 0U : 100U, 1, 0, {}};
    if (i % k == 0) {
      info.yardstick = at_db(25);
      frame.quality = at_db(100);
      fast.quality = at_db(30 + double(i));
    }
    t.frames.push_back(info);
    t.modes[0].frames.push_back(frame);
    t.modes[1].frames.push_back(fast);
  }
  return t;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

// Moves and lines of all paths of a plot, and its dots.
struct Strokes {
  std::size_t moves = 0, lines = 0, dots = 0;
};

Strokes strokes_of(const TemporaryFolder& folder, const std::string& name) {
  const std::string svg = read_file(folder / name);
  Strokes strokes;
  strokes.dots = count_of(svg, "<circle");
  for (std::size_t at = svg.find("<path d=\""); at != std::string::npos;
       at = svg.find("<path d=\"", at + 1)) {
    const std::string path = svg.substr(at + 9, svg.find('"', at + 9) - at - 9);
    strokes.moves += count_of(path, "M"), strokes.lines += count_of(path, "L");
  }
  return strokes;
}

TEST(Plots, LinesJoinTheFramesThatWereCompared) {
  for (const std::size_t k : {1, 2, 3, 5}) {
    SCOPED_TRACE(k);
    const TemporaryFolder folder;
    write_plots(folder.path(), compared_every(k, 12));
    const std::size_t n_compared = (12 + k - 1) / k;
    for (const char* name : {"psnr.svg", "psnr_covered.svg"}) {
      const Strokes strokes = strokes_of(folder, name);
      EXPECT_EQ(strokes.moves, 2u) << name;  // the hybrid and the yardstick
      EXPECT_EQ(strokes.lines, 2 * (n_compared - 1)) << name;
    }
    for (const char* name : {"frame_ms.svg", "triangles.svg"}) {
      EXPECT_EQ(strokes_of(folder, name).moves, 2u) << name;  // a frame of no triangles, too
      EXPECT_EQ(strokes_of(folder, name).lines, 22u) << name;
    }
  }
}

TEST(Plots, OneFrameShowsAsDots) {
  const TemporaryFolder folder;
  write_plots(folder.path(), compared_every(1, 1));
  for (const char* name : {"psnr.svg", "psnr_covered.svg", "frame_ms.svg", "triangles.svg"})
    EXPECT_EQ(strokes_of(folder, name).dots, 2u) << name;
}

// A frame in which nothing shows says nothing of quality.
TEST(Plots, LinesPassOverFramesInWhichNothingShows) {
  const TemporaryFolder folder;
  Timeline timeline = compared_every(1, 5);
  timeline.modes[1].frames[3].quality.n_covered_px = 0;
  write_plots(folder.path(), timeline);
  const Strokes strokes = strokes_of(folder, "psnr.svg");
  EXPECT_EQ(strokes.moves, 2u);
  EXPECT_EQ(strokes.lines, 4u + 3);
}

TEST(Plots, NothingComparedIsSaid) {
  const TemporaryFolder folder;
  Timeline timeline = compared_every(1, 5);
  for (ModeTimeline& mode : timeline.modes)
    for (FrameRecord& frame : mode.frames) frame.quality = {};
  for (FrameInfo& frame : timeline.frames) frame.yardstick = {};
  write_plots(folder.path(), timeline);
  EXPECT_EQ(count_of(read_file(folder / "psnr.svg"), "nothing was measured"), 1u);
  EXPECT_EQ(count_of(read_file(folder / "frame_ms.svg"), "nothing was measured"), 0u);
}

}  // namespace
}  // namespace viewcell
