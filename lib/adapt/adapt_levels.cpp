#include "adapt/adapt_levels.h"

#include "adapt/gl_texture_adapt.h"
#include "adapt/resolve_index_map.h"
#include "base/error.h"

namespace viewcell {

TexelKind parse_texel_kind(const std::string& name) {
  if (name == "float") return TexelKind::float32;
  if (name == "half") return TexelKind::float16;
  if (name == "16") return TexelKind::unorm16;
  if (name == "8") return TexelKind::unorm8;
  if (name == "texture") return TexelKind::texture;
  throw UsageError("'" + name + "' is no kind of texel: float, half, 16, 8 or texture");
}

class AdaptLevels::Adapter {
 public:
  virtual ~Adapter() = default;
  virtual void go_to(std::size_t n_collapsed) = 0;
  virtual const AdaptCounts& counts() const = 0;
  virtual IndexMap map() const = 0;
  virtual void let_go() = 0;
  virtual ImageRgba8 texture() const = 0;
};

// Engine: TextureAdapter or GlTextureAdapter.
template <typename Texel, typename Engine>
class AdaptLevels::AdapterOf : public Adapter {
 public:
  explicit AdapterOf(Engine adapter) : adapter_(std::move(adapter)) {}
  void go_to(std::size_t n_collapsed) override {
    VIEWCELL_CHECK(adapter_.has_value());
    adapter_->go_to(n_collapsed);
    counts_.n_adaptations = adapter_->counts().n_adaptations;
    counts_.n_packs = adapter_->counts().n_packs;
    if constexpr (std::is_same_v<Engine, TextureAdapter<Texel>>) counts_ = adapter_->counts();
  }
  void let_go() override { adapter_.reset(); }
  const AdaptCounts& counts() const override { return counts_; }
  IndexMap map() const override {
    if constexpr (std::is_same_v<Texel, glm::vec2>)
      return adapter_->image();
    else if constexpr (std::is_same_v<Texel, Rgba8>)
      VIEWCELL_CHECK(false);
    else
      return float_from(adapter_->image());
    return {};
  }
  ImageRgba8 texture() const override {
    if constexpr (std::is_same_v<Texel, Rgba8>) return adapter_->image();
    VIEWCELL_CHECK(false);
    return {};
  }

 private:
  std::optional<Engine> adapter_;
  AdaptCounts counts_;
};

namespace {

AdaptLevelsOptions with_size(AdaptLevelsOptions options, const ImageRgba8& texture) {
  if (options.width_px <= 0) options.width_px = texture.width_px;
  if (options.height_px <= 0) options.height_px = texture.height_px;
  return options;
}

}  // namespace

AdaptLevels::AdaptLevels(const ProgressiveRecord& record, const AdaptationLog& log,
                         const ImageRgba8& texture, const AdaptLevelsOptions& options)
    : log_(log),
      texture_(texture),
      options_(with_size(options, texture)),
      mesh_(make_finest(record)),
      finest_(make_level_charts(mesh_, log)) {
  if (options_.start) mesh_.set_faces(options_.start_faces);
  const int width_px = options_.width_px, height_px = options_.height_px;
  const LevelCharts owners = make_owner_charts(mesh_, log_);
  const auto make = [&]<typename Texel>(Image<Texel> image) {
    if (options_.gl)
      adapter_ =
          std::make_unique<AdapterOf<Texel, GlTextureAdapter<Texel>>>(GlTextureAdapter<Texel>(
              *options_.gl, log_, image, owners, n_collapsed(), {.pack = options_.adapt.pack}));
    else
      adapter_ = std::make_unique<AdapterOf<Texel, TextureAdapter<Texel>>>(
          TextureAdapter<Texel>(log_, image, owners, n_collapsed(), options_.adapt));
  };
  const auto make_map = [&]<typename Texel>(Texel) {
    if (options_.start)
      make(from_float<Texel>(*options_.start));
    else
      make(make_index_map<Texel>(width_px, height_px));
  };
  if (options_.start &&
      (options_.start->width_px != width_px || options_.start->height_px != height_px))
    throw UsageError("the map to start from has another size than is wanted");
  switch (options_.texel) {
    case TexelKind::float32:
      make_map(glm::vec2());
      break;
    case TexelKind::float16:
      make_map(HalfTexel());
      break;
    case TexelKind::unorm16:
      make_map(Unorm16Texel());
      break;
    case TexelKind::unorm8:
      make_map(Unorm8Texel());
      break;
    case TexelKind::texture:
      make(texture);
      break;
  }
  options_.start.reset();
}

AdaptLevels::~AdaptLevels() = default;

void AdaptLevels::set_faces(std::size_t n) {
  mesh_.set_faces(n);
  adapter_->go_to(n_collapsed());
  if (options_.gl) options_.gl->Finish();
}

const AdaptCounts& AdaptLevels::counts() const {
  return adapter_->counts();
}

IndexMap AdaptLevels::map() const {
  return adapter_->map();
}

IndexMap AdaptLevels::take_map() {
  IndexMap out = map();
  adapter_->let_go();
  return out;
}

ImageRgba8 AdaptLevels::bake() const {
  if (options_.texel == TexelKind::texture) return adapter_->texture();
  return bake(texture_);
}

ImageRgba8 AdaptLevels::bake(const ImageRgba8& texture, const IndexMap& map) const {
  return resolve_index_map(map, texture, finest_, charts(), options_.adapt.n_threads);
}

}  // namespace viewcell
