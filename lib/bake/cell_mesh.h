// SVMesh and MVMesh: the textured level of detail of one object for one view cell.
#pragma once

#include <array>
#include <vector>

#include "bake/start_levels.h"
#include "bake/vertex_weights.h"
#include "bundle/representation.h"
#include "cells/cells.h"
#include "pm/collapse_loop.h"
#include "scene/scene.h"

namespace viewcell {

struct BakeOptions {
  double ts_px = 5;           ///< T_s: self-occluding error up to which one view is enough
  double tl_px = 4.5;         ///< T_l: cost at which collapsing ends
  int resolution_px = 1024;   ///< of the captures, per face width
  double max_drift_px = 0.5;  ///< see ViewMetricOptions
  /// Start from a level whose error projects to less; 0: from the original.
  double start_error_px = 0.125;
  double unseen_error_px = 1;  ///< likewise, of the level that an unseen object is
  CategoryOptions categories;
  WeightOptions weights;
};

/// What baking needs to know of a scene besides the captures. Read-only once built.
struct BakeScene {
  const Scene& scene;
  const CellSet& cells;
  std::vector<StartLevels> meshes;  ///< by mesh
  std::vector<Box> boxes;           ///< by object, world
};

/// Builds the levels of every mesh: some seconds for a million triangles.
BakeScene build_bake_scene(const Scene& scene, const CellSet& cells, int n_threads);

/// What represents an object in a cell and, if the object is outside it, what was computed to
/// choose that and is reused to build its mesh.
struct CellObject {
  ObjectId object{};
  Representation kind = Representation::original;
  const StartLevel* level = nullptr;  ///< of the BakeScene; null inside, where the rest is empty
  ViewVertices vertices;              ///< the level's, world; no weights, no views yet
  FaceSides sides;                    ///< of the level's triangles
};

/// As it is, or unseen from the cell (the cells say so), or one view where the self-occluding error
/// is below T_s, else several. Every object of a cell is exactly one of them, in every tool.
CellObject choose_representation(const BakeScene& bake, CellId cell, ObjectId object,
                                 const BakeOptions& options);

/// The mesh of one object for one cell, world space.
struct CellMesh {
  ObjectId object{};
  ViewVertices vertices;
  std::vector<std::uint32_t> source_vertex;  ///< numbers in the object's mesh as drawn (SceneMesh)
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> views;  ///< per triangle: the views that its three corners share
};

struct CellMeshCounts {
  std::size_t n_original = 0;     ///< triangles of the object; n_start and what follows count
                                  ///< twins (SplitMesh) once, n_out does not
  std::size_t n_start = 0;        ///< of the level that collapsing started from
  std::size_t n_back_facing = 0;  ///< of those, back-facing to the whole cell
  std::size_t n_out = 0;
  CollapseCounts collapses;
};

/// object: of choose_representation, outside; of an unseen one, without views, the level as it is.
/// Follows: [Chen06 5.2.1], SVMesh with the views' first
/// alone, MVMesh with all that see the object. Differs: triangles that are back-facing to the whole
/// cell are culled after collapsing, not before, so that the rim of what is left is an edge loop of
/// a closed surface and not the ragged border of the facing triangles; and an SVMesh keeps what
/// faces any point of the cell, not its centre alone (no holes at silhouettes when the eye leaves
/// the centre).
CellMesh derive_mesh(const BakeScene& bake, CellId cell, CellObject object,
                     std::span<const ClassifiedView> views, const BakeOptions& options,
                     CellMeshCounts& counts);

}  // namespace viewcell
