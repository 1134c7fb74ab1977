// A walk through a scene, where one can stand.
#pragma once

#include <vector>

#include "scene/camera.h"
#include "walk/standing_room.h"

namespace viewcell {

struct WalkOptions {
  std::vector<glm::dvec2> through;  ///< places to pass, in that order; none: the room's own length
  double seconds = 0;               ///< the walk ends then; 0: where the route does
  double eye_height = 18;           ///< above the floor
  double speed = 14;                ///< units a second; 1.25 m of an eye at 1.6 m
};

struct Walk {
  CameraPath path;
  double length = 0;      ///< of the route that is walked
  double room_share = 0;  ///< of the grid's points: free and connected to the walk
};

/// Along the shortest routes between the places, rounded where there is room, looking ahead along
/// the route, level. Without places: in the largest part of the room, between the points farthest
/// apart of those with half the most to see, by where there is much to see; and of a route longer
/// than the walk, the stretch with the most. Throws InputError (name) when nobody can stand
/// anywhere, and for a place that no route leads to. The same every time.
Walk make_walk(const StandingRoom& room, const WalkOptions& options, const std::string& name);

}  // namespace viewcell
