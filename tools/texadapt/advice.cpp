#include "texadapt/advice.h"

#include "base/json.h"

namespace viewcell {
namespace {

// The options in made_by, as pmesh build writes it; of others nothing is known.
Json build_options_of(const ProgressiveRecord& record) {
  const Json made_by = Json::parse(record.made_by, nullptr, false);
  if (!made_by.is_object() || !made_by.contains("options")) return Json::object();
  return made_by["options"].is_object() ? made_by["options"] : Json::object();
}

// These refuse folds of the texture anyhow.
bool measures_texture(const Json& options) {
  const Json metric = options.value("metric", Json());
  return metric == "qem5" || metric == "aps" || metric == "mapping";
}

}  // namespace

std::string advise_no_folds(const ProgressiveRecord& record, std::size_t n_folded) {
  const Json options = build_options_of(record);
  if (n_folded == 0 || options.contains("refuse_folds") || measures_texture(options)) return "";
  return " (pmesh build --no-folds refuses most of them)";
}

std::string advise_charts_apart(const ProgressiveRecord& record) {
  if (build_options_of(record).contains("charts_apart_px")) return "";
  return " (pmesh build --charts-apart refuses most of that)";
}

std::string explain_base(std::size_t n_base, std::size_t n_charts) {
  constexpr std::size_t kFewFaces = 4;  // a chart
  if (n_charts < 2 || n_base > kFewFaces * n_charts) return "";
  return "; its texture has " + std::to_string(n_charts) +
         " charts, and each keeps a face: pmesh build --no-texture goes on, and --engine rebake "
         "--onto makes a texture for what it gives";
}

}  // namespace viewcell
