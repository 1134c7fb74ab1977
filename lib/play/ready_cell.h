// A cell's geometry made ready for the GPU, on the loading thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "bundle/bundle.h"
#include "draw/lit_vertex.h"

namespace viewcell {

struct ReadyObject {
  ObjectId object{};
  Representation kind = Representation::single_view;
  std::uint32_t first_index = 0, n_indices = 0;
  glm::vec3 lo{0}, hi{0};    ///< world box
  std::uint8_t windows = 0;  ///< bit k: some of it lies beyond side face k of the cell
};

/// An object of Representation::unseen.
struct UnseenObject {
  std::uint32_t first_index = 0, n_indices = 0;
  glm::vec3 lo{0}, hi{0};
  std::uint8_t windows = 0;
};

/// A vertex of one, lit already.
struct UnseenVertex {
  glm::vec3 position{0};
  Rgba8 color{0, 0, 0, 255};  ///< sRGB
};
static_assert(sizeof(UnseenVertex) == 16);

struct ReadyCell {
  CellId cell{};
  glm::dvec3 origin{0};
  std::vector<ReadyObject> objects;
  /// Relative to origin, the eye at the cell's centre, so that floats stay exact near it.
  std::vector<LitVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<UnseenObject> unseen;
  std::vector<UnseenVertex> unseen_vertices;
  std::vector<std::uint32_t> unseen_indices;
};

ReadyCell make_ready_cell(const Scene& scene, const CellSet& cells, CellId cell,
                          const CellGeometry& geometry);

}  // namespace viewcell
