#include "rays/ray_packet.h"

#include <cmath>
#include <limits>

namespace viewcell {

void RayPacket::start(const glm::vec3& origin, float near_in) {
  origin_x.fill(origin.x), origin_y.fill(origin.y), origin_z.fill(origin.z);
  near.fill(near_in);
  far.fill(std::numeric_limits<float>::infinity());
  time.fill(0);
  mask.fill(~0u), id.fill(0), flags.fill(0);
  geometry.fill(kNothing), instance.fill(kNothing);
}

void RayPacket::pass_hit(int i) {
  near[at(i)] = std::nextafter(far[at(i)], std::numeric_limits<float>::infinity());
  far[at(i)] = std::numeric_limits<float>::infinity();
  geometry[at(i)] = instance[at(i)] = kNothing;
}

}  // namespace viewcell
