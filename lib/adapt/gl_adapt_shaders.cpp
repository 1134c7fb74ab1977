#include "adapt/gl_adapt_shaders.h"

#include <string>

#include "adapt/texel_owners.h"

namespace viewcell {
namespace {

constexpr const char* kGlslVersion = "#version 450 core\n";

constexpr const char* kClipFromTexel = R"(
vec4 clip_from_texel(vec2 at) { return vec4((at + 0.5) * (2 / vec2(kSize)) - 1, 0.5, 1); }
)";

constexpr const char* kSampleVertex = R"(
layout(location = 0) in vec2 to;
layout(location = 1) in vec2 from;
layout(location = 0) noperspective out vec2 source;
void main() {
  source = SOURCE;
  gl_Position = clip_from_texel(to);
}
)";

constexpr const char* kCopyVertex = R"(
layout(location = 0) in vec2 to;
layout(location = 1) in vec2 from;
layout(location = 0) flat out uint what;
void main() {
  what = uint(from.x);
  gl_Position = clip_from_texel(to);
}
)";

constexpr const char* kOwnedVertex = R"(
layout(location = 0) in vec2 to;
layout(location = 1) in vec2 local_in;
layout(location = 2) in vec4 line_in;
layout(location = 3) in vec4 limits_in;
layout(location = 4) in float side_in;
layout(location = 5) in uvec4 owners_in;
layout(location = 0) noperspective out vec2 local;
layout(location = 1) flat out vec4 line;
layout(location = 2) flat out vec4 limits;
layout(location = 3) flat out float side;
layout(location = 4) flat out uvec4 what;
void main() {
  local = local_in, line = line_in, limits = limits_in, side = side_in, what = owners_in;
  gl_Position = clip_from_texel(to);
}
)";

// Values as they are kept, and the texel's own texture coordinates.
constexpr const char* kValues = R"(
layout(binding = 0) uniform sampler2D values;
layout(binding = 1) uniform usampler2D owners;
layout(location = 0) out Value value_out;
Value value_at(ivec2 texel) { return texelFetch(values, texel, 0).CHANNELS; }
uint owner_at(ivec2 texel) { return texelFetch(owners, texel, 0).r; }
ivec2 here() { return ivec2(gl_FragCoord.xy); }
Value own_texcoords() { return Value((vec2(here()) + 0.5) / vec2(kSize) FILL); }
)";

constexpr const char* kStoreExact = R"(
void store(Value v) { value_out = v; }
)";
// To the nearest with 10 bits of mantissa, ties to even; a driver that cuts the rest off cuts
// zeros.
constexpr const char* kStoreHalf = R"(
void store(Value v) {
  uvec2 bits = floatBitsToUint(v);
  bits += 0xfffu + ((bits >> 13) & 1u);
  value_out = uintBitsToFloat(bits & ~uvec2(0x1fffu));
}
)";

// Bilinear, by the sampler's own filter.
constexpr const char* kSampleFiltered = R"(
layout(location = 0) noperspective in vec2 source;
void main() { store(textureLod(values, source, 0).CHANNELS); }
)";

// Bilinear. Gathered at the corner between four texels, with weights of single precision; those of
// a filtering sampler may have eight bits. By texelFetch() an adaptation takes llvmpipe 8 % longer.
constexpr const char* kSample = R"(
layout(location = 0) noperspective in vec2 source;
void main() {
  vec2 at = clamp(source, vec2(0), vec2(kSize - 1));
  vec2 p = floor(at), f = at - p, g = 1 - f;
  vec2 corner = (p + 1) / vec2(kSize);
  vec4 weights = vec4(g.x * f.y, f.x * f.y, f.x * g.y, g.x * g.y);
  store(Value(GATHER));
}
)";

constexpr const char* kCopyValues = R"(
layout(location = 0) flat in uint what;
void main() {
  Value value = value_at(here());
  if (what == 0u)
    value_out = value;
  else
    store(own_texcoords());
}
)";

constexpr const char* kCopyOwned = R"(
layout(location = 0) flat in uint what;
layout(location = 1) out uint owner_out;
void main() {
  uint owner = owner_at(here());
  value_out = value_at(here());
  owner_out = what != 0u && owner == (kInside | what) ? 0u : owner;
}
)";

// what: the owner to be, the chart, the star's first corner, how many; see OwnedVertex.
constexpr const char* kSampleOwned = R"(
layout(location = 0) noperspective in vec2 local;
layout(location = 1) flat in vec4 line;
layout(location = 2) flat in vec4 limits;
layout(location = 3) flat in float side;
layout(location = 4) flat in uvec4 what;
layout(binding = 2) uniform samplerBuffer star;
layout(location = 1) out uint owner_out;

const float kEdge = 1e-3;  // square texels: the star's texels on its inner edges are in it

float turn(vec2 a, vec2 b, vec2 p) {
  vec2 u = b - a, v = p - a;
  return u.x * v.y - u.y * v.x;
}

// n: of the corners; 0 for texels that need no answer, so that a renderer that runs both sides of a
// branch for all texels of a block skips the loop.
bool is_in_star(vec2 p, int n) {
  int first = int(what.z);
  bool found = false;
  for (int k = 0; k < n; k += 3) {
    vec2 a = texelFetch(star, first + k).rg, b = texelFetch(star, first + k + 1).rg;
    vec2 c = texelFetch(star, first + k + 2).rg;
    vec3 turns = vec3(turn(a, b, p), turn(b, c, p), turn(c, a, p));
    found = found || all(greaterThan(turns, vec3(-kEdge))) || all(lessThan(turns, vec3(kEdge)));
  }
  return found;
}

// From texels of the chart only; from all four where none of them is the chart's.
Value sample_own(vec2 source) {
  vec2 at = clamp(source, vec2(0), vec2(kSize - 1));
  ivec2 p = ivec2(at), q = min(p + 1, kSize - 1);
  vec2 f = at - vec2(p), g = 1 - f;
  ivec2 texels[4] = ivec2[4](p, ivec2(q.x, p.y), ivec2(p.x, q.y), q);
  float weights[4] = float[4](g.x * g.y, f.x * g.y, g.x * f.y, f.x * f.y);
  Value all_sum = Value(0), own_sum = Value(0);
  float own_weight = 0;
  for (int k = 0; k < 4; ++k) {
    Value part = weights[k] * value_at(texels[k]);
    bool is_own = (owner_at(texels[k]) & ~kInside) == what.y;
    all_sum += part;
    own_sum += is_own ? part : Value(0);
    own_weight += is_own ? weights[k] : 0;
  }
  return own_weight > 1e-3 ? own_sum / own_weight : all_sum;
}

void main() {
  uint owner = owner_at(here());
  if (what.x != 0u) {
    bool is_free = (owner & kInside) == 0u || owner == what.x;
    bool may_be_in_star = !is_free && owner == (kInside | what.y);
    int n = may_be_in_star ? int(what.w & 0x7fffffffu) : 0;
    if (!is_in_star(vec2(here()), n) && !is_free) discard;
    owner = what.x;
  }
  owner_out = owner;
  vec2 along = line.zw, out_ = vec2(along.y, -along.x) * side;
  vec2 at = clamp(local, limits.xy, limits.zw);
  Value sampled = sample_own(line.xy + at.x * along + at.y * out_);
  store((what.w & 0x80000000u) != 0u ? own_texcoords() : sampled);
}
)";

}  // namespace

AdaptPrograms make_adapt_programs(const Gl& gl, int width_px, int height_px,
                                  const AdaptShaderOptions& options) {
  const std::string size = "const ivec2 kSize = ivec2(" + std::to_string(width_px) + ", " +
                           std::to_string(height_px) +
                           ");\nconst uint kInside = " + std::to_string(kInsideChart) + "u;\n";
  const std::string vertex =
      kGlslVersion + size +
      (options.filters ? "#define SOURCE (from + 0.5) / vec2(kSize)\n" : "#define SOURCE from\n") +
      kClipFromTexel;
  const std::string fragment =
      kGlslVersion + size +
      (options.n_channels == 4
           ? "#define Value vec4\n#define CHANNELS rgba\n#define FILL , 0, 0\n#define GATHER G(0), "
             "G(1), G(2), G(3)\n"
           : "#define Value vec2\n#define CHANNELS rg\n#define FILL\n#define GATHER G(0), G(1)\n") +
      "#define G(k) dot(textureGather(values, corner, k), weights)\n" + kValues +
      (options.rounds_to_half ? kStoreHalf : kStoreExact);
  return {GlProgram(gl, "copy owned texels", vertex + kCopyVertex, fragment + kCopyOwned),
          GlProgram(gl, "copy texels", vertex + kCopyVertex, fragment + kCopyValues),
          GlProgram(gl, "adapt texels", vertex + kSampleVertex,
                    fragment + (options.filters ? kSampleFiltered : kSample)),
          GlProgram(gl, "adapt owned texels", vertex + kOwnedVertex, fragment + kSampleOwned)};
}

}  // namespace viewcell
