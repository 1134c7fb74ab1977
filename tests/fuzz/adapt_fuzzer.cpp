// Logs of adaptations, and textures that follow them.
#include "adapt/adapt_file.h"
#include "adapt/adapt_levels.h"
#include "base/file.h"
#include "fuzz.h"
#include "small_record.h"

namespace viewcell {
namespace {

void replay(const ProgressiveRecord& record, const AdaptationLog& log) {
  constexpr int kSidePx = 16;
  const ImageRgba8 texture(kSidePx, kSidePx, {1, 2, 3, 255});
  for (const TexelKind kind : {TexelKind::float32, TexelKind::texture}) {
    AdaptLevelsOptions options;
    options.texel = kind;
    options.adapt.n_threads = 1;
    AdaptLevels levels(record, log, texture, options);
    levels.set_faces(1);
    levels.set_faces(record.faces.size());
    hold(levels.bake().pixels.size() == texture.pixels.size(), "textures keep their size");
  }
}

}  // namespace
}  // namespace viewcell

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  static const ProgressiveRecord record = make_small_record();
  const auto file = put_input("in.adapt", view_of(data, n_bytes));
  AdaptationLog log;
  if (!is_taken([&] { log = read_adapt(file, record); })) return 0;
  const auto first = fuzz_folder() / "first.adapt", second = fuzz_folder() / "second.adapt";
  write_adapt(first, log, record);
  write_adapt(second, read_adapt(first, record), record);
  hold(read_file(first) == read_file(second), "what is written reads back");
  replay(record, log);
  return 0;
}
