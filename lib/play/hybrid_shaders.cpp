#include "play/hybrid_shaders.h"

#include "play/shading.h"

namespace viewcell {
namespace {

constexpr const char* kBlock = R"(
layout(std140, binding = 0) uniform DrawBlock {
  vec4 base_color;     // linear
  vec4 weights;        // of views 0 and 1
  vec4 rows[9];        // s, t, q of views 0, 1, 2
  ivec4 regions[3];    // first texel, width, height
  vec4 codes[3];       // scale, bias
};
)";

std::string number(int i) {
  return std::to_string(i);
}

// The declarations that vertex and fragment shader share, as out or in. Whatever is the same for a
// whole draw is read from the block by the fragments instead: covered pixels are few, and a
// software rasteriser sets up every varying for every triangle.
std::string varyings(const std::string& direction, int n_views) {
  std::string out = "layout(location = 0) " + direction + " vec3 normal_world;\n";
  for (int k = 0; k < n_views; ++k)
    out +=
        "layout(location = " + number(1 + k) + ") " + direction + " vec3 stq" + number(k) + ";\n";
  return out;
}

// Four texels around the point, weighted bilinearly; only those at the fragment's own depth count.
// Returns colour times weight, and the weight.
const char* kGuardedFetch = R"(
layout(binding = 0) uniform samplerBuffer texels;
vec4 guarded_fetch(vec3 stq, ivec4 region, vec4 code) {
  if (region.y == 0 || stq.z <= 0.0) return vec4(0);
  float r = 1.0 / stq.z;
  vec2 at = clamp(stq.xy * r - 0.5, vec2(0), vec2(region.yz) - 1.001);
  ivec2 corner = ivec2(at);
  vec2 f = at - vec2(corner);
  int i = region.x + corner.y * region.y + corner.x;
  vec4 t00 = texelFetch(texels, i), t10 = texelFetch(texels, i + 1);
  i += region.y;
  vec4 t01 = texelFetch(texels, i), t11 = texelFetch(texels, i + 1);
  vec4 away = abs(vec4(t00.a, t10.a, t01.a, t11.a) - (code.x * r + code.y));
  vec4 w = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
  w *= step(away, vec4(DEPTH_TOLERANCE));
  return vec4(w.x * t00.rgb + w.y * t10.rgb + w.z * t01.rgb + w.w * t11.rgb, dot(w, vec4(1)));
}
)";

// Below this weight a view says nothing of the fragment.
const char* kSingleViewMain = R"(
void main() {
  vec4 sum = guarded_fetch(stq0, regions[0], codes[0]);
  if (sum.w > 0.01) color = vec4(sum.rgb / sum.w, 1.0);
  else color = vec4(srgb_encode(shade(base_color.xyz, normalize(normal_world))), 254.0 / 255.0);
}
)";

const char* kMultiViewMain = R"(
void main() {
  vec4 sum = weights.x * guarded_fetch(stq0, regions[0], codes[0]);
  if (weights.y > 0.0) sum += weights.y * guarded_fetch(stq1, regions[1], codes[1]);
  if (sum.w < 0.01) sum = guarded_fetch(stq2, regions[2], codes[2]);
  if (sum.w > 0.001) color = vec4(sum.rgb / sum.w, 1.0);
  else color = vec4(srgb_encode(shade(base_color.xyz, normalize(normal_world))), 254.0 / 255.0);
}
)";

const char* kLitMain = R"(
void main() {
  color = vec4(srgb_encode(shade(base_color.xyz, normalize(normal_world))), 254.0 / 255.0);
}
)";

}  // namespace

std::string make_hybrid_vertex_glsl(int n_views) {
  std::string out = std::string("#version 450 core\n") +
                    "layout(location = 0) in vec3 position;\n"
                    "layout(location = 1) in vec3 normal;\n"
                    "uniform mat4 clip_from_local;\n" +
                    kBlock + varyings("out", n_views) +
                    "void main() {\n"
                    "  vec4 p = vec4(position, 1);\n"
                    "  gl_Position = clip_from_local * p;\n"
                    "  normal_world = normal;\n"
                    "";
  for (int k = 0; k < n_views; ++k) {
    const std::string i = number(k);
    const auto row = [&](int r) { return "dot(rows[" + number(3 * k + r) + "], p)"; };
    out += "  stq" + i + " = vec3(" + row(0) + ", " + row(1) + ", " + row(2) + ");\n";
  }
  return out + "}\n";
}

std::string make_hybrid_fragment_glsl(int n_views, const Lighting& lighting,
                                      float depth_tolerance) {
  std::string fetch = kGuardedFetch;
  const std::string name = "DEPTH_TOLERANCE";
  fetch.replace(fetch.find(name), name.size(), std::to_string(depth_tolerance));
  return "#version 450 core\n" + varyings("in", n_views) +
         "layout(location = 0) out vec4 color;\n" + kBlock + make_shading_glsl(lighting) +
         (n_views > 0 ? fetch : "") +
         (n_views == 0   ? kLitMain
          : n_views == 1 ? kSingleViewMain
                         : kMultiViewMain);
}

std::string make_edge_fragment_glsl() {
  return "#version 450 core\n" + varyings("in", 0) +
         "layout(location = 0) out vec4 color;\n"
         "void main() { color = vec4(0.15, 0.15, 0.15, 1.0); }\n";
}

}  // namespace viewcell
