#include "play/residency.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/error.h"

namespace viewcell {
namespace {

// The prefetch list is rebuilt when the eye has moved by this share of a cell's size, or turned
// by this much: the paper's timestamp.
constexpr double kMoved = 0.1;
const double kTurnedCosine = std::cos(glm::radians(10.0));

void upload_unseen(const Gl& gl, const ReadyCell& ready, ResidentCell& cell) {
  cell.unseen_vertices = make_buffer(gl, ready.unseen_vertices);
  cell.unseen_indices = make_buffer(gl, ready.unseen_indices);
  cell.unseen_array = GlVertexArray(gl);
  gl.VertexArrayVertexBuffer(cell.unseen_array.id(), 0, cell.unseen_vertices.id(), 0,
                             sizeof(UnseenVertex));
  gl.VertexArrayElementBuffer(cell.unseen_array.id(), cell.unseen_indices.id());
  cell.unseen_array.set_attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(UnseenVertex, position));
  cell.unseen_array.set_attribute(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(UnseenVertex, color));
}

ResidentCell upload_cell(const Gl& gl, std::shared_ptr<const ReadyCell> ready) {
  ResidentCell cell;
  cell.vertices = make_buffer(gl, ready->vertices);
  cell.indices = make_buffer(gl, ready->indices);
  cell.array = GlVertexArray(gl);
  gl.VertexArrayVertexBuffer(cell.array.id(), 0, cell.vertices.id(), 0, sizeof(LitVertex));
  gl.VertexArrayElementBuffer(cell.array.id(), cell.indices.id());
  cell.array.set_attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(LitVertex, position));
  cell.array.set_attribute(1, 3, GL_SHORT, GL_TRUE, offsetof(LitVertex, normal));
  if (!ready->unseen.empty()) upload_unseen(gl, *ready, cell);
  cell.ready = std::move(ready);
  return cell;
}

glm::dvec3 vec3_of(const double (&v)[3]) {
  return {v[0], v[1], v[2]};
}

ViewProjection make_projection(const BundleTile& tile, const glm::dvec3& origin,
                               std::uint32_t first_texel) {
  const glm::dvec3 right = vec3_of(tile.right), up = vec3_of(tile.up);
  const glm::dvec3 forward = vec3_of(tile.forward);
  const glm::dvec3 from_eye = origin - vec3_of(tile.eye);
  const auto row = [&](const glm::dvec3& axis) {
    return glm::dvec4(axis, glm::dot(axis, from_eye));
  };
  // x_px - crop.x = (half - crop.x) + focal * right / depth; texel centres are at +0.5.
  const double half = 0.5 * tile.source_px;
  const glm::dvec4 q = row(forward);
  ViewProjection out;
  out.row_q = glm::vec4(q);
  out.row_s = glm::vec4((half - tile.x) * q + tile.focal_px * row(right));
  out.row_t = glm::vec4((half - tile.y) * q - tile.focal_px * row(up));
  out.first_texel = static_cast<std::int32_t>(first_texel + tile.first_texel);
  out.width_px = tile.width_px, out.height_px = tile.height_px;
  out.focal_px = static_cast<float>(tile.focal_px);
  out.eye = glm::vec3(-from_eye);
  out.code_scale = static_cast<float>(tile.code_scale / 255);
  out.code_bias = static_cast<float>(tile.code_bias / 255);
  return out;
}

}  // namespace

Residency::Residency(const Gl& gl, const Bundle& bundle, const ResidencyOptions& options)
    : gl_(gl),
      bundle_(bundle),
      options_(options),
      pool_(gl, options.pool_texels),
      loader_(bundle) {}

CellId Residency::cell_of(const Camera& camera) const {
  const HexGrid& grid = bundle_.cells().grid;
  const auto cell = cell_at(grid, coord_at(grid, glm::dvec2(camera.eye)));
  if (!cell) throw InputError("path", "", "the eye leaves the grid of cells");
  if (!bundle_.has(*cell))
    throw InputError("path", "",
                     "the eye enters cell " + std::to_string(static_cast<int>(*cell)) +
                         ", which the bundle does not hold");
  return *cell;
}

std::vector<CentreId> Residency::centres_needed(CellId cell) const {
  std::vector<CentreId> out;
  for (const CentreId centre : views_of(bundle_.cells().grid, cell))
    if (bundle_.has(centre)) out.push_back(centre);
  return out;
}

const ResidentCell& Residency::enter(const Camera& camera) {
  ++frame_;
  const CellId cell = cell_of(camera);
  for (Loaded& loaded : loader_.collect()) take(std::move(loaded));
  if (cell != current_) {
    current_ = cell;
    bring(cell);
    evict_cells();
  }
  Cell& entered = cells_.at(cell);
  entered.used_at = frame_;
  if (options_.prefetch) {
    upload_ahead();
    request_ahead(camera);
  }
  return entered.resident;
}

void Residency::take(Loaded loaded) {
  if (const auto* cell = std::get_if<CellId>(&loaded.key))
    add_cell(*cell, std::move(loaded));
  else
    add_centre(std::get<CentreId>(loaded.key), std::move(loaded));
}

void Residency::add_cell(CellId id, Loaded loaded) {
  if (cells_.contains(id)) return;
  Cell cell{{}, frame_, std::move(loaded.fault)};
  if (loaded.cell) cell.resident = upload_cell(gl_, std::move(loaded.cell));
  cells_.emplace(id, std::move(cell));
}

void Residency::add_centre(CentreId id, Loaded loaded) {
  if (centres_.contains(id)) return;
  Centre centre{{}, 0, std::move(loaded.textures), frame_, std::move(loaded.fault)};
  const auto n = static_cast<std::uint32_t>(centre.textures.texels.size());
  if (n > 0) {
    centre.first = pool_.allocate(n);
    while (!centre.first && evict_a_centre()) centre.first = pool_.allocate(n);
    if (!centre.first)
      throw MachineError("textures of one cell need more than the pool's " +
                         std::to_string(pool_.n_texels() / (1 << 18)) + " MB");
    queue_.push_back(id);
  }
  centres_.emplace(id, std::move(centre));
}

void Residency::note_fault(const std::string& what, StandIn stand_in) {
  const auto is_it = [&](const BundleFault& fault) { return fault.what == what; };
  if (!what.empty() && std::none_of(faults_.begin(), faults_.end(), is_it))
    faults_.push_back({what, stand_in});
}

std::uint32_t Residency::upload_some(Centre& centre, std::uint32_t most) {
  if (centre.is_whole()) return 0;
  const std::vector<Rgba8>& texels = centre.textures.texels;
  const std::uint32_t n =
      std::min(most, static_cast<std::uint32_t>(texels.size()) - centre.n_written);
  pool_.write(*centre.first + centre.n_written, texels.data() + centre.n_written, n);
  centre.n_written += n;
  if (centre.n_written == texels.size()) loader_.recycle(std::exchange(centre.textures.texels, {}));
  return n;
}

void Residency::upload_ahead() {
  std::uint32_t left = options_.texels_per_frame;
  while (left > 0 && !queue_.empty()) {
    const auto found = centres_.find(queue_.front());
    if (found != centres_.end()) left -= upload_some(found->second, left);
    if (found == centres_.end() || found->second.is_whole()) queue_.pop_front();
  }
}

// Reads and uploads at once what the cell still lacks.
void Residency::bring(CellId cell) {
  bool stalled = false;
  const auto read = [&](const LoadKey& key) {
    stalled = true;
    take(loader_.read(key));
  };
  if (!cells_.contains(cell)) read(cell);
  Cell& entered = cells_.at(cell);
  ResidentCell& resident = entered.resident;
  resident.stand_in = resident.ready ? StandIn::none : StandIn::damaged_cell;
  note_fault(entered.fault, StandIn::damaged_cell);
  for (const CentreId id : centres_needed(cell)) {
    if (!resident.ready) break;  // nothing would show them
    if (!centres_.contains(id)) read(id);
    Centre& centre = centres_.at(id);
    centre.used_at = frame_;
    upload_some(centre, ~0u);
    note_fault(centre.fault, StandIn::damaged_textures);
    if (!centre.fault.empty()) resident.stand_in = StandIn::damaged_textures;
  }
  n_stalls_ += stalled;
  if (resident.ready) project_views(cell, resident);
}

void Residency::project_views(CellId id, ResidentCell& cell) const {
  const std::size_t n = cell.ready->objects.size();
  std::vector<int> slot_of(bundle_.scene().objects.size(), -1);
  for (std::size_t slot = 0; slot < n; ++slot)
    slot_of[index(cell.ready->objects[slot].object)] = static_cast<int>(slot);
  cell.views.assign(n, 0);
  cell.projections.assign(n * kViews, {});
  const auto views = views_of(bundle_.cells().grid, id);
  for (std::size_t k = 0; k < views.size(); ++k) {
    const auto centre = centres_.find(views[k]);
    if (centre == centres_.end()) continue;
    for (const BundleTile& tile : centre->second.textures.tiles) {
      const int slot = slot_of[static_cast<std::size_t>(tile.object)];
      if (slot < 0) continue;
      const auto at = static_cast<std::size_t>(slot);
      cell.views[at] |= static_cast<std::uint8_t>(1u << k);
      cell.projections[at * kViews + k] =
          make_projection(tile, cell.ready->origin, *centre->second.first);
    }
  }
}

// Neighbours by how soon the eye may be there: nearer first, those ahead before those behind.
void Residency::request_ahead(const Camera& camera) {
  const HexGrid& grid = bundle_.cells().grid;
  if (glm::length(camera.eye - asked_eye_) < kMoved * grid.size &&
      glm::dot(camera.forward, asked_forward_) > kTurnedCosine)
    return;
  asked_eye_ = camera.eye, asked_forward_ = camera.forward;
  std::vector<std::pair<double, CellId>> order;
  for (int face = 0; face < 6; ++face) {
    const HexCoord hex = neighbour(coord_of(grid, current_), face);
    const auto cell = cell_at(grid, hex);
    if (!cell || !bundle_.has(*cell)) continue;
    const glm::dvec2 to = centre_of(grid, hex) - glm::dvec2(camera.eye);
    const double ahead = glm::dot(to, glm::dvec2(camera.forward));
    order.emplace_back(glm::length(to) - 0.5 * ahead, *cell);
  }
  std::sort(order.begin(), order.end());
  std::vector<LoadKey> keys;
  std::set<CentreId> listed;
  for (const auto& [urgency, cell] : order) {
    if (!cells_.contains(cell)) keys.emplace_back(cell);
    for (const CentreId centre : centres_needed(cell))
      if (!centres_.contains(centre) && listed.insert(centre).second) keys.emplace_back(centre);
  }
  loader_.request(keys);
}

bool Residency::is_needed(CentreId centre) const {
  const auto needed = centres_needed(current_);
  return std::find(needed.begin(), needed.end(), centre) != needed.end();
}

// The centre that was used longest ago and that the current cell does not need.
bool Residency::evict_a_centre() {
  auto oldest = centres_.end();
  for (auto it = centres_.begin(); it != centres_.end(); ++it)
    if (!is_needed(it->first) &&
        (oldest == centres_.end() || it->second.used_at < oldest->second.used_at))
      oldest = it;
  if (oldest == centres_.end()) return false;
  if (oldest->second.first) pool_.release(*oldest->second.first);
  centres_.erase(oldest);
  return true;
}

void Residency::evict_cells() {
  while (cells_.size() > options_.n_cells) {
    auto oldest = cells_.end();
    for (auto it = cells_.begin(); it != cells_.end(); ++it)
      if (it->first != current_ &&
          (oldest == cells_.end() || it->second.used_at < oldest->second.used_at))
        oldest = it;
    cells_.erase(oldest);
  }
}

}  // namespace viewcell
