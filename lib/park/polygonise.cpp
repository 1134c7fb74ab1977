#include "park/polygonise.h"

#include <array>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"

namespace viewcell {
namespace {

constexpr int kShift = 2, kSide = 1 << kShift;  // nodes along a block
constexpr int kNodes = kSide * kSide * kSide;
constexpr int kGroup = 4;  // blocks along a group, which shares one narrowed view of the figure
constexpr std::int32_t kNone = -1;
constexpr std::int64_t kMaxBlocks = 1 << 26;

using Cell = glm::ivec3;

// The samples near the surface. Far blocks hold no samples, only a sign.
struct Grid {
  Figure const* figure = nullptr;
  glm::dvec3 origin{0};
  double cell = 1;
  float floor_z = 0;
  glm::ivec3 n_blocks{0};
  std::vector<std::int32_t> slot;      // block -> index into values and views; kNone: far
  std::vector<std::int8_t> is_inside;  // far block -> its sign
  std::vector<std::array<float, kNodes>> values;
  std::vector<FigureView> views;

  std::size_t block_index(const glm::ivec3& b) const {
    return (static_cast<std::size_t>(b.z) * static_cast<std::size_t>(n_blocks.y) +
            static_cast<std::size_t>(b.y)) *
               static_cast<std::size_t>(n_blocks.x) +
           static_cast<std::size_t>(b.x);
  }
  static int node_index(const Cell& c) {
    return ((c.z & (kSide - 1)) * kSide + (c.y & (kSide - 1))) * kSide + (c.x & (kSide - 1));
  }
  std::int32_t slot_of(const Cell& c) const {
    return slot[block_index({c.x >> kShift, c.y >> kShift, c.z >> kShift})];
  }
  float value(const Cell& c) const {
    const std::size_t b = block_index({c.x >> kShift, c.y >> kShift, c.z >> kShift});
    if (slot[b] == kNone) return is_inside[b] ? -1.0f : 1.0f;
    return values[static_cast<std::size_t>(slot[b])][static_cast<std::size_t>(node_index(c))];
  }
  glm::vec3 point(const glm::vec3& node) const {
    return glm::vec3(origin + cell * glm::dvec3(node));
  }
};

glm::ivec3 corner_offset(int k) {
  return {k & 1, (k >> 1) & 1, (k >> 2) & 1};
}

// The lowest node of a block, and so on, for all blocks of the grid in order.
template <typename Visit>
void for_each_block(const glm::ivec3& lo, const glm::ivec3& hi, const Visit& visit) {
  for (int z = lo.z; z < hi.z; ++z)
    for (int y = lo.y; y < hi.y; ++y)
      for (int x = lo.x; x < hi.x; ++x) visit(glm::ivec3(x, y, z));
}

Grid make_grid(const Figure& figure, const PolygoniseOptions& options) {
  Box box = figure_box(figure);
  VIEWCELL_CHECK(box.lo.x < box.hi.x && options.cell > 0, options.cell);
  box.lo.z = std::max(box.lo.z, options.floor_z);
  Grid grid;
  grid.figure = &figure;
  grid.cell = options.cell;
  grid.floor_z = static_cast<float>(options.floor_z);
  grid.origin = box.lo - 2.5 * options.cell;
  const glm::dvec3 n = (box.hi - grid.origin) / (options.cell * kSide) + 1.0;
  VIEWCELL_CHECK(n.x * n.y * n.z < static_cast<double>(kMaxBlocks), options.cell);
  grid.n_blocks = glm::ivec3(n);
  const std::size_t n_all = grid.block_index({0, 0, grid.n_blocks.z});
  grid.slot.assign(n_all, kNone);
  grid.is_inside.assign(n_all, 0);
  return grid;
}

// A block that the surface may pass through, with what decides the surface there.
struct NearBlock {
  glm::ivec3 block;
  FigureView view;
};

// Splits the group of blocks from `lo` into far blocks, whose signs it sets, and near ones.
void classify_group(Grid& grid, const FigureView& all, const glm::ivec3& lo,
                    std::vector<NearBlock>& out) {
  const glm::ivec3 hi = glm::min(lo + kGroup, grid.n_blocks);
  const auto centre = [&](const glm::ivec3& from, const glm::ivec3& to) {
    return grid.point(0.5f * static_cast<float>(kSide) * glm::vec3(from + to));
  };
  // One cell more than half the diagonal, for the cells that straddle blocks.
  const auto reach = [&](int side) {
    return static_cast<float>(grid.cell * (0.5 * std::sqrt(3.0) * side * kSide + 1.8));
  };
  const FigureView group = all.near(centre(lo, lo + kGroup), reach(kGroup));
  for_each_block(lo, hi, [&](const glm::ivec3& block) {
    const glm::vec3 middle = centre(block, block + 1);
    FigureView view = group.near(middle, reach(1));
    const float value = std::max(view.value(middle), grid.floor_z - middle.z);
    if (std::abs(value) > 1.3f * reach(1))
      grid.is_inside[grid.block_index(block)] = value < 0;
    else
      out.push_back({block, std::move(view)});
  });
}

void find_near_blocks(Grid& grid, int n_threads, std::vector<NearBlock>& blocks) {
  const FigureView all(*grid.figure);
  const glm::ivec3 n_groups = (grid.n_blocks + kGroup - 1) / kGroup;
  std::vector<glm::ivec3> groups;
  for_each_block(glm::ivec3(0), n_groups,
                 [&](const glm::ivec3& g) { groups.push_back(g * kGroup); });
  std::vector<std::vector<NearBlock>> found(groups.size());
  parallel_for(groups.size(), n_threads,
               [&](std::size_t i) { classify_group(grid, all, groups[i], found[i]); });
  for (std::vector<NearBlock>& some : found)
    for (NearBlock& block : some) blocks.push_back(std::move(block));
}

void sample(Grid& grid, int n_threads) {
  std::vector<NearBlock> blocks;
  find_near_blocks(grid, n_threads, blocks);
  grid.values.resize(blocks.size());
  grid.views.reserve(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    grid.slot[grid.block_index(blocks[i].block)] = static_cast<std::int32_t>(i);
    grid.views.push_back(std::move(blocks[i].view));
  }
  parallel_for(blocks.size(), n_threads, [&](std::size_t i) {
    const glm::ivec3 lo = blocks[i].block * kSide;
    for_each_block(lo, lo + kSide, [&](const Cell& node) {
      const glm::vec3 p = grid.point(glm::vec3(node));
      grid.values[i][static_cast<std::size_t>(Grid::node_index(node))] =
          std::max(grid.views[i].value(p), grid.floor_z - p.z);
    });
  });
}

// --- well-composedness: no two inside (or outside) nodes may touch over a diagonal only ---

// Makes the outside node least outside of those in `mask` (of the cell's corners) an inside one.
void fill_one(Grid& grid, const Cell& cell, unsigned mask) {
  Cell best{};
  float least = 2e9f;
  for (int k = 0; k < 8; ++k) {
    if (!(mask >> k & 1)) continue;
    const Cell node = cell + corner_offset(k);
    if (const float v = grid.value(node); v >= 0 && v < least) least = v, best = node;
  }
  const std::int32_t slot = grid.slot_of(best);
  VIEWCELL_CHECK(slot != kNone);
  grid.values[static_cast<std::size_t>(slot)][static_cast<std::size_t>(Grid::node_index(best))] =
      static_cast<float>(-1e-3 * grid.cell);
}

// The corners of a cell (as bits) between which a node must be filled; 0: none.
unsigned find_conflict(unsigned inside) {
  // the six faces: corners in the order diagonal, diagonal, and the other two
  static constexpr int faces[6][4] = {{0, 3, 1, 2}, {4, 7, 5, 6}, {0, 5, 1, 4},
                                      {2, 7, 3, 6}, {0, 6, 2, 4}, {1, 7, 3, 5}};
  for (const auto& f : faces) {
    const unsigned a = 1u << f[0] | 1u << f[1], b = 1u << f[2] | 1u << f[3];
    if ((inside & (a | b)) == a) return b;
    if ((inside & (a | b)) == b) return a;
  }
  for (int k = 0; k < 4; ++k) {  // two opposite corners of the cube against the other six
    const unsigned pair = 1u << k | 1u << (7 - k);
    if (inside == pair || inside == (0xffu & ~pair)) return 0xffu & ~inside;
  }
  return 0;
}

unsigned inside_corners(const Grid& grid, const Cell& cell) {
  unsigned inside = 0;
  for (int k = 0; k < 8; ++k)
    if (grid.value(cell + corner_offset(k)) < 0) inside |= 1u << k;
  return inside;
}

// The grid's outermost layer is outside by the margin, so that cells never look beyond it.
template <typename Visit>
void for_each_near_cell(const Grid& grid, const Visit& visit) {
  for_each_block(glm::ivec3(0), grid.n_blocks, [&](const glm::ivec3& block) {
    if (grid.slot[grid.block_index(block)] == kNone) return;
    const glm::ivec3 lo = block * kSide;
    for_each_block(lo, glm::min(lo + kSide, grid.n_blocks * kSide - 1), visit);
  });
}

void make_well_composed(Grid& grid) {
  for (bool changed = true; changed;) {
    changed = false;
    for_each_near_cell(grid, [&](const Cell& cell) {
      for (unsigned mask; (mask = find_conflict(inside_corners(grid, cell))) != 0; changed = true)
        fill_one(grid, cell, mask);
    });
  }
}

// --- the surface net ---

// The mean of the points where the surface crosses the cell's edges.
glm::vec3 net_point(const Grid& grid, const Cell& cell) {
  glm::vec3 sum(0);
  float n = 0;
  for (int k = 0; k < 8; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      if (k >> axis & 1) continue;
      const glm::ivec3 a = corner_offset(k), b = corner_offset(k | 1 << axis);
      const float va = grid.value(cell + a), vb = grid.value(cell + b);
      if ((va < 0) == (vb < 0)) continue;
      sum += glm::mix(glm::vec3(a), glm::vec3(b), va / (va - vb));
      n += 1;
    }
  return grid.point(glm::vec3(cell) + sum / n);
}

// One Newton step towards the surface, half a cell at most. Points on the floor stay on it.
glm::vec3 project(const Grid& grid, const FigureView& view, const glm::vec3& p) {
  const float h = static_cast<float>(0.1 * grid.cell);
  if (p.z < grid.floor_z + 2 * h) return p;
  const auto at = [&](float x, float y, float z) { return view.value(p + h * glm::vec3(x, y, z)); };
  const glm::vec3 gradient = glm::vec3(at(1, 0, 0) - at(-1, 0, 0), at(0, 1, 0) - at(0, -1, 0),
                                       at(0, 0, 1) - at(0, 0, -1)) /
                             (2 * h);
  const float g2 = glm::dot(gradient, gradient);
  if (g2 < 0.05f) return p;
  glm::vec3 step = -view.value(p) / g2 * gradient;
  const float longest = static_cast<float>(0.5 * grid.cell), length = glm::length(step);
  if (length > longest) step *= longest / length;
  glm::vec3 out = p + step;
  out.z = std::max(out.z, grid.floor_z);
  return out;
}

// cell -> vertex, in blocks like the samples.
using VertexOfCell = std::vector<std::array<std::int32_t, kNodes>>;

VertexOfCell place_vertices(const Grid& grid, int n_threads, TriMesh& mesh) {
  VertexOfCell vertex(grid.values.size());
  std::vector<Cell> cells;
  for_each_near_cell(grid, [&](const Cell& cell) {
    const unsigned inside = inside_corners(grid, cell);
    if (inside == 0 || inside == 0xff) return;
    vertex[static_cast<std::size_t>(grid.slot_of(cell))]
          [static_cast<std::size_t>(Grid::node_index(cell))] =
              static_cast<std::int32_t>(cells.size());
    cells.push_back(cell);
  });
  mesh.positions.resize(cells.size());
  constexpr std::size_t kBatch = 1024;
  parallel_for((cells.size() + kBatch - 1) / kBatch, n_threads, [&](std::size_t batch) {
    for (std::size_t i = batch * kBatch; i < std::min(cells.size(), (batch + 1) * kBatch); ++i) {
      const FigureView& view = grid.views[static_cast<std::size_t>(grid.slot_of(cells[i]))];
      mesh.positions[i] = project(grid, view, net_point(grid, cells[i]));
    }
  });
  return vertex;
}

void add_quad(TriMesh& mesh, const std::array<std::uint32_t, 4>& q) {
  const auto length2 = [&](std::size_t a, std::size_t b) {
    const glm::vec3 d = mesh.positions[q[a]] - mesh.positions[q[b]];
    return glm::dot(d, d);
  };
  if (length2(0, 2) <= length2(1, 3)) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  } else {
    mesh.triangles.push_back({q[0], q[1], q[3]});
    mesh.triangles.push_back({q[1], q[2], q[3]});
  }
}

// A quad across every edge of the grid that the surface crosses, between the four cells around it.
void join_vertices(const Grid& grid, const VertexOfCell& vertex, TriMesh& mesh) {
  const auto vertex_of = [&](const Cell& cell) {
    return static_cast<std::uint32_t>(vertex[static_cast<std::size_t>(grid.slot_of(cell))]
                                            [static_cast<std::size_t>(Grid::node_index(cell))]);
  };
  for_each_near_cell(grid, [&](const Cell& node) {
    const bool is_inside = grid.value(node) < 0;
    for (int axis = 0; axis < 3; ++axis) {
      Cell u(0), v(0), along(0);
      along[axis] = 1, u[(axis + 1) % 3] = 1, v[(axis + 2) % 3] = 1;
      if ((grid.value(node + along) < 0) == is_inside) continue;
      const std::uint32_t a = vertex_of(node - u - v), b = vertex_of(node - v);
      const std::uint32_t c = vertex_of(node), d = vertex_of(node - u);
      is_inside ? add_quad(mesh, {a, b, c, d}) : add_quad(mesh, {a, d, c, b});
    }
  });
}

}  // namespace

TriMesh polygonise(const Figure& figure, const PolygoniseOptions& options) {
  Grid grid = make_grid(figure, options);
  sample(grid, options.n_threads);
  make_well_composed(grid);
  TriMesh mesh;
  const VertexOfCell vertex = place_vertices(grid, options.n_threads, mesh);
  join_vertices(grid, vertex, mesh);
  return mesh;
}

}  // namespace viewcell
