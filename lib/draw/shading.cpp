#include "draw/shading.h"

#include <array>
#include <charconv>
#include <cmath>

namespace viewcell {
namespace {

// Least maximum error of a quartic in sqrt(x) against 1.055 x^(1/2.4) - 0.055 on [0.0031308, 1]:
// 0.19 of 255. Below, the curve is the line, which the maximum of the two picks; they meet with an
// error of 0.23 of 255.
constexpr std::array<float, 5> kSrgbFit{-0.03700429f, 1.44788737f, -0.94480663f, 0.84271573f,
                                        -0.30953997f};
constexpr float kToe = 0.0031308f, kToeSlope = 12.92f;

// The shortest text that reads back as the same float; GLSL takes "1" for an int, so a point is
// added where there is none.
std::string glsl_float(float x) {
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
  std::string out(text.data(), end);
  if (out.find_first_of(".e") == std::string::npos) out += ".0";
  return out;
}

std::string srgb_glsl() {
  std::string polynomial = glsl_float(kSrgbFit.back());
  for (std::size_t i = kSrgbFit.size() - 1; i-- > 0;)
    polynomial = "(" + polynomial + ") * s + " + glsl_float(kSrgbFit[i]);
  return "vec3 srgb_encode(vec3 linear) {\n"
         "  vec3 x = clamp(linear, 0.0, 1.0);\n"
         "  vec3 s = sqrt(x);\n"
         "  return max(" +
         polynomial + ", " + glsl_float(kToeSlope) + " * min(x, " + glsl_float(kToe) + "));\n}\n";
}

}  // namespace

std::string glsl_vec3(const glm::vec3& v) {
  return "vec3(" + glsl_float(v.x) + ", " + glsl_float(v.y) + ", " + glsl_float(v.z) + ")";
}

float quick_srgb_encode(float linear) {
  const float x = std::fmin(std::fmax(linear, 0.0f), 1.0f);
  const float s = std::sqrt(x);
  float y = kSrgbFit.back();
  for (std::size_t i = kSrgbFit.size() - 1; i-- > 0;) y = y * s + kSrgbFit[i];
  return std::fmax(y, kToeSlope * std::fmin(x, kToe));
}

std::string make_shading_glsl(const Lighting& l) {
  return make_shade_glsl({glsl_vec3(l.toward_light), glsl_vec3(l.light), glsl_vec3(l.ambient_sky),
                          glsl_vec3(l.ambient_ground)}) +
         srgb_glsl();
}

}  // namespace viewcell
