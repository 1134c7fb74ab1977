// Where pictures of a mesh are taken from: a frame that several meshes may share, and views of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "scene/camera.h"

namespace viewcell {

/// A sphere in a mesh's own coordinates, and which axis points up. *Frame space* has it as the unit
/// sphere about the origin with z up and the front toward -y. Two meshes' pictures can be compared
/// only when both are drawn in one frame: a simplified mesh's own box is a little smaller.
struct MeshFrame {
  glm::dvec3 centre{0};
  double radius = 1;     ///< above 0
  std::string up = "z";  ///< "x", "y" or "z", turned by turn_up_axis
};

/// The box of the vertices that triangles use: the others show nothing.
Box box_of_triangles(const TriMesh& mesh);

/// "x0,y0,z0:x1,y1,z1". Throws UsageError unless all are finite and none of the first is above its
/// partner.
Box parse_box(const std::string& text);

/// The axis that the file's format has up: y for OBJ, GLB and glTF, else z.
std::string up_axis_of(const std::filesystem::path& mesh_file);

/// The sphere through the box's corners. Throws InputError naming `source` when the box is a point.
MeshFrame make_frame(const Box& box, const std::string& up, const std::string& source);

/// Points from the mesh's coordinates to frame space and back; directions are only turned.
glm::dvec3 frame_from_mesh(const MeshFrame& frame, const glm::dvec3& point);
glm::dvec3 mesh_from_frame(const MeshFrame& frame, const glm::dvec3& point_frame);
glm::dvec3 mesh_from_frame_direction(const MeshFrame& frame, const glm::dvec3& direction_frame);

/// The farthest vertex in use from the frame's centre, in radii. Above kViewMargin a picture may
/// cut the mesh off.
double measure_reach(const TriMesh& mesh, const MeshFrame& frame);

inline constexpr double kViewFovDeg = 30;
inline constexpr double kViewMargin = 1.02;  ///< radii of the sphere that a picture just holds
inline constexpr std::size_t kMostViews = 400;

/// n cameras in frame space, in [1, kMostViews], each looking at the centre from the same distance
/// and holding the sphere: they depend on n alone. Directions lie on a spherical Fibonacci lattice
/// (equal steps of height, azimuth by the golden angle; Gonzalez 2010), so they cover all sides
/// evenly and none is vertical. The first is the one nearest to 20 degrees above the horizon, and
/// all are turned about z until it looks from the front, 35 degrees to the mesh's left hand; the
/// others follow from the top down. n = 1: just that, at 20 degrees.
std::vector<Camera> make_views(std::size_t n);

/// Degrees above the horizon, and around z from the front, in (-180, 180], of the eye.
struct ViewAngles {
  double elevation_deg = 0, azimuth_deg = 0;
};
ViewAngles angles_of(const Camera& view);

/// Turns directions about z so that the eye comes to stand before the front: a light that is
/// constant in the space it leads to follows the camera around, and up stays up.
glm::dmat3 turn_eye_to_front(const Camera& view);

}  // namespace viewcell
