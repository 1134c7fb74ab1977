#include "draw/index_map_lookup.h"

namespace viewcell {

// The patch a b c d, the texels beside it on its four lines, and where f is measured from:
//
//               above_c   above_d           v
//   r1[0]  --      c   --    d  --  r1[3]   ^
//   r0[0]  --      a   --    b  --  r0[3]   |
//               below_a   below_b           +--> u
std::string index_map_glsl() {
  return "const float jump_texels = " + std::to_string(kJumpTexels) + ";\n" + R"(
layout(binding = 1) uniform sampler2D index_map;

struct IndexedTexcoords {
  vec2 uv, dx, dy;
};

// The coordinates that a texel holds, in texels of the map; any texel: the map is periodic.
vec2 map_at(ivec2 texel) {
  ivec2 size = textureSize(index_map, 0);
  ivec2 wrapped = (texel % size + size) % size;
  return texelFetch(index_map, wrapped, 0).xy * vec2(size) + vec2(texel - wrapped);
}

// Four coordinates in a line: does the middle step leave the range of its neighbours' steps?
bool jumps(vec2 a, vec2 b, vec2 c, vec2 d) {
  vec2 before = b - a, step_here = c - b, after = d - c;
  vec2 slack = jump_texels + 0.5 * max(abs(before), abs(after));
  vec2 lo = min(min(before, after), 0) - slack, hi = max(max(before, after), 0) + slack;
  return any(lessThan(step_here, lo)) || any(greaterThan(step_here, hi));
}

IndexedTexcoords indexed_texcoords(vec2 uv) {
  vec2 size = vec2(textureSize(index_map, 0));
  vec2 uv_dx = dFdx(uv), uv_dy = dFdy(uv);
  vec2 at = uv * size - 0.5;
  vec2 corner = floor(at), f = at - corner;
  ivec2 first = ivec2(corner);
  vec2 r0[4], r1[4];
  for (int k = 0; k < 4; ++k) {
    r0[k] = map_at(first + ivec2(k - 1, 0));
    r1[k] = map_at(first + ivec2(k - 1, 1));
  }
  vec2 a = r0[1], b = r0[2], c = r1[1], d = r1[2];
  vec2 below_a = map_at(first + ivec2(0, -1)), below_b = map_at(first + ivec2(1, -1));
  vec2 above_c = map_at(first + ivec2(0, 2)), above_d = map_at(first + ivec2(1, 2));
  if (jumps(r0[0], a, b, r0[3]) || jumps(r1[0], c, d, r1[3]) ||
      jumps(below_a, a, c, above_c) || jumps(below_b, b, d, above_d)) {
    vec2 nearest = f.x < 0.5 ? (f.y < 0.5 ? a : c) : (f.y < 0.5 ? b : d);
    return IndexedTexcoords(nearest / size, uv_dx, uv_dy);
  }
  vec2 mixed = mix(mix(a, b, f.x), mix(c, d, f.x), f.y);
  // Change of the coordinates, in texels, over one texel of the map.
  mat2 jacobian = mat2(mix(b - a, d - c, f.y), mix(c - a, d - b, f.x));
  return IndexedTexcoords(mixed / size, jacobian * (uv_dx * size) / size,
                          jacobian * (uv_dy * size) / size);
}
)";
}

}  // namespace viewcell
