// Ids are types; an int is a count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace viewcell {

/// A view cell of a grid, row-major: row * columns + column.
enum class CellId : std::int32_t {};
/// An object of a scene: its index in scene.json's "objects".
enum class ObjectId : std::int32_t {};
/// A mesh of a scene: its index in scene.json's "meshes".
enum class MeshId : std::int32_t {};
/// A centre from which objects are captured: a hexagon of the grid widened by its rim
/// (cells/grid.h says how they are numbered).
enum class CentreId : std::int32_t {};

/// The id as an index into an array.
template <typename Id>
requires std::is_enum_v<Id>
constexpr std::size_t index(Id id) {
  return static_cast<std::size_t>(id);
}

}  // namespace viewcell
