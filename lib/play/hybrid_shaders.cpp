#include "play/hybrid_shaders.h"

#include "draw/shading.h"

namespace viewcell {
namespace {

constexpr const char* kBlock = R"(
layout(std140, binding = 0) uniform DrawBlock {
  vec4 base_color;     // linear
  vec4 weights;        // of views 0 and 1; z: 1 where backs are seen
  vec4 rows[6];        // s, t, q of views 0, 1
  ivec4 regions[2];    // first texel, width, height
  vec4 codes[2];       // scale, bias, 1 / tolerance
  vec4 eyes[3];        // of views 0, 1, and of the frame; cell-local
};
)";

std::string number(int i) {
  return std::to_string(i);
}

// The declarations that vertex and fragment shader share, as out or in. Whatever is the same for a
// whole draw is read from the block by the fragments instead: covered pixels are few, and a
// software rasteriser sets up every varying for every triangle. It also runs both sides of every
// branch, so the colour for what no view shows is made at the vertices.
std::string varyings(const std::string& direction, int n_views, DrawnSides sides) {
  std::string out = "layout(location = 0) " + direction + " vec3 lit;  // encoded\n";
  for (int k = 0; k < n_views; ++k)
    out +=
        "layout(location = " + number(1 + k) + ") " + direction + " vec3 stq" + number(k) + ";\n";
  if (sides == DrawnSides::front) return out;
  return out + "layout(location = 3) " + direction + " vec3 lit_back;\n" + "layout(location = 4) " +
         direction + " vec3 local;\n";
}

constexpr const char* kTexels = "layout(binding = 0) uniform samplerBuffer texels;\n";

// In a fetch: the four texels around the point, and their bilinear weights.
const char* kFourTexels = R"(
  float r = 1.0 / stq.z;
  vec2 at = clamp(stq.xy * r - 0.5, vec2(0), vec2(region.yz) - 1.001);
  ivec2 corner = ivec2(at);
  vec2 f = at - vec2(corner);
  int i = region.x + corner.y * region.y + corner.x;
  vec4 t00 = texelFetch(texels, i), t10 = texelFetch(texels, i + 1);
  i += region.y;
  vec4 t01 = texelFetch(texels, i), t11 = texelFetch(texels, i + 1);
  vec4 w = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
)";

// Four texels around the point, weighted bilinearly and by how near their depth is to the
// fragment's own: with x = difference / tolerance, 1 / (1 + x^8), nearly a step. Where no texel is
// within the tolerance the nearest in depth wins, unless all are far off (make_textured_main).
// Returns colour times weight, and the weight.
std::string make_guarded_fetch() {
  return R"(
vec4 guarded_fetch(vec3 stq, ivec4 region, vec4 code) {
  if (region.y == 0 || stq.z <= 0.0) return vec4(0);
)" + std::string(kFourTexels) +
         R"(  vec4 away = abs(vec4(t00.a, t10.a, t01.a, t11.a) - (code.x * r + code.y));
  vec4 far = away * code.z;
  far *= far;
  far *= far;
  w /= 1.0 + far * far;
  return vec4(w.x * t00.rgb + w.y * t10.rgb + w.z * t01.rgb + w.w * t11.rgb, dot(w, vec4(1)));
}
)";
}

// The same for surfaces with holes, where a texel of code 0 shows nothing of the object. Beside
// it: the colour of texels that show the fragment or what lies before it, and their share. The rest
// see through the place where the fragment is.
std::string make_masked_fetch() {
  return R"(
vec4 masked_fetch(vec3 stq, ivec4 region, vec4 code, out vec4 shown) {
  shown = vec4(0);
  if (region.y == 0 || stq.z <= 0.0) return vec4(0);
)" + std::string(kFourTexels) +
         R"(  vec4 codes = vec4(t00.a, t10.a, t01.a, t11.a);
  vec4 nearer = (codes - (code.x * r + code.y)) * code.z;  // in tolerances
  vec4 stops = w * step(0.5 / 255.0, codes) * step(-1.6, nearer);
  shown = vec4(stops.x * t00.rgb + stops.y * t10.rgb + stops.z * t01.rgb + stops.w * t11.rgb,
               dot(stops, vec4(1)));
  vec4 far = nearer * nearer;
  far *= far;
  stops /= 1.0 + far * far;
  return vec4(stops.x * t00.rgb + stops.y * t10.rgb + stops.z * t01.rgb + stops.w * t11.rgb,
              dot(stops, vec4(1)));
}
)";
}

// lit_color(); and how much view k counts, which on the other side of the triangle is nothing.
const char* kFrontOnly = R"(
vec3 lit_color() { return lit; }
float side_weight(int k) { return 1.0; }
)";
const char* kBothSides = R"(
vec3 lit_color() { return gl_FrontFacing ? lit : lit_back; }
float side_weight(int k) {
  vec3 across = cross(dFdx(local), dFdy(local));
  return dot(across, eyes[2].xyz - local) * dot(across, eyes[k].xyz - local) > 0.0 ? 1.0 : 0.0;
}
)";

const char* kLitMain = R"(
void main() { color = vec4(lit_color(), 254.0 / 255.0); }
)";

// Below a weight of 0.02, at about 1.6 tolerances from every texel, no view shows the
// fragment.
std::string make_textured_main(int n_views) {
  std::string sum = "side_weight(0) * guarded_fetch(stq0, regions[0], codes[0])";
  if (n_views == 2)
    sum = "weights.x * " + sum +
          " + weights.y * side_weight(1) * guarded_fetch(stq1, regions[1], codes[1])";
  return "void main() {\n  vec4 sum = " + sum +
         ";\n"
         "  bool is_seen = sum.w > 0.02;\n"
         "  color = vec4(is_seen ? sum.rgb / sum.w : lit_color(), is_seen ? 1.0 : 254.0 / "
         "255.0);\n}\n";
}

// A view counts for holes where it sees the fragment's side, or the surface is drawn from behind
// too. A fragment that no view shows, but none sees through, has the colour of what hides it.
std::string make_masked_main(int n_views) {
  std::string main =
      "void main() {\n"
      "  vec4 sum = vec4(0), stopped = vec4(0), shown;\n"
      "  float counted = 0.0, side, counts;\n"
      "  vec4 fetched;\n";
  for (int k = 0; k < n_views; ++k) {
    const std::string n = number(k);
    main += "  side = side_weight(" + n + ");\n" + "  counts = weights[" + n +
            "] * max(side, weights.z);\n" + "  fetched = masked_fetch(stq" + n + ", regions[" + n +
            "], codes[" + n + "], shown);\n" + "  sum += weights[" + n + "] * side * fetched;\n" +
            "  if (regions[" + n + "].y > 0 && stq" + n +
            ".z > 0.0) stopped += counts * shown, counted += counts;\n";
  }
  return main +
         "  if (stopped.a < 0.5 * counted) discard;\n"
         "  bool is_seen = sum.w > 0.02;\n"
         "  vec3 other = stopped.a > 0.02 ? stopped.rgb / stopped.a : lit_color();\n"
         "  color = vec4(is_seen ? sum.rgb / sum.w : other, is_seen ? 1.0 : 254.0 / 255.0);\n"
         "}\n";
}

}  // namespace

std::string make_hybrid_vertex_glsl(int n_views, DrawnSides sides, const Lighting& lighting) {
  std::string out = std::string("#version 450 core\n") +
                    "layout(location = 0) in vec3 position;\n"
                    "layout(location = 1) in vec3 normal;\n"
                    "uniform mat4 clip_from_local;\n" +
                    kBlock + make_shading_glsl(lighting) + varyings("out", n_views, sides) +
                    "void main() {\n"
                    "  vec4 p = vec4(position, 1);\n"
                    "  gl_Position = clip_from_local * p;\n"
                    "  lit = srgb_encode(shade(base_color.xyz, normalize(normal)));\n";
  if (sides != DrawnSides::front)
    out +=
        "  lit_back = srgb_encode(shade(base_color.xyz, -normalize(normal)));\n"
        "  local = position;\n";
  for (int k = 0; k < n_views; ++k) {
    const auto row = [&](int r) { return "dot(rows[" + number(3 * k + r) + "], p)"; };
    out += "  stq" + number(k) + " = vec3(" + row(0) + ", " + row(1) + ", " + row(2) + ");\n";
  }
  return out + "}\n";
}

std::string make_hybrid_fragment_glsl(int n_views, DrawnSides sides) {
  const std::string out = "#version 450 core\n" + varyings("in", n_views, sides) +
                          "layout(location = 0) out vec4 color;\n" + kBlock +
                          (sides != DrawnSides::front ? kBothSides : kFrontOnly);
  if (n_views == 0) return out + kLitMain;
  if (sides == DrawnSides::masked)
    return out + kTexels + make_masked_fetch() + make_masked_main(n_views);
  return out + kTexels + make_guarded_fetch() + make_textured_main(n_views);
}

std::string make_edge_fragment_glsl() {
  return "#version 450 core\n" + varyings("in", 0, DrawnSides::front) +
         "layout(location = 0) out vec4 color;\n"
         "void main() { color = vec4(0.15, 0.15, 0.15, 1.0); }\n";
}

}  // namespace viewcell
