#include "play/texel_pool.h"

#include <gtest/gtest.h>

#include <cstring>

#include "base/error.h"
#include "base/random.h"
#include "draw/gl_fixture.h"

namespace viewcell {
namespace {

// A texel a flag: the longest free range and the first that fits, by looking at every texel.
struct Model {
  std::vector<bool> used;
  explicit Model(std::size_t n) : used(n) {}
  std::optional<std::uint32_t> first_fit(std::uint32_t n) const {
    std::uint32_t run = 0;
    for (std::uint32_t i = 0; i < used.size(); ++i) {
      run = used[i] ? 0 : run + 1;
      if (run == n) return i + 1 - n;
    }
    return {};
  }
  void fill(std::uint32_t first, std::uint32_t n, bool value) {
    for (std::uint32_t i = first; i < first + n; ++i) {
      ASSERT_NE(used.at(i), value) << "texel " << i;
      used[i] = value;
    }
  }
};

TEST(TexelPool, TakesWhatAModelTakes) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    constexpr std::uint32_t kTexels = 300;
    TexelPool pool(shared_context().gl(), kTexels);
    Model model(kTexels);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> held;
    std::uint32_t n_used = 0;
    int n_refused = 0;
    for (int k = 0; k < 500; ++k) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " step " << k);
      if (random.below(5) < 3 || held.empty()) {
        const std::uint32_t n = 1 + random.below(60);
        const auto first = pool.allocate(n);
        ASSERT_EQ(first, model.first_fit(n));
        n_refused += !first;
        if (!first) continue;
        model.fill(*first, n, true);
        held.emplace_back(*first, n);
        n_used += n;
      } else {
        const auto at = held.begin() + random.below(static_cast<std::uint32_t>(held.size()));
        pool.release(at->first);
        model.fill(at->first, at->second, false);
        n_used -= at->second;
        held.erase(at);
      }
      ASSERT_EQ(pool.n_used(), n_used);
    }
    EXPECT_GT(n_refused, 10);
  }
}

TEST(TexelPool, FullPoolsSayNo) {
  TexelPool pool(shared_context().gl(), 10);
  EXPECT_EQ(pool.n_texels(), 10u);
  EXPECT_FALSE(pool.allocate(11));
  EXPECT_EQ(pool.allocate(10), 0u);
  EXPECT_FALSE(pool.allocate(1));
  pool.release(0);
  EXPECT_EQ(pool.n_used(), 0u);
  EXPECT_EQ(pool.allocate(10), 0u);
  EXPECT_THROW(pool.release(1), BugError);
}

// Read back through a shader-visible buffer texture: its texels are what was written.
TEST(TexelPool, HoldsWhatWasWritten) {
  const Gl& gl = shared_context().gl();
  TexelPool pool(gl, 64);
  std::vector<Rgba8> texels(64);
  for (std::size_t i = 0; i < 64; ++i)
    texels[i] = {static_cast<std::uint8_t>(4 * i), 7, static_cast<std::uint8_t>(255 - i), 9};
  pool.write(0, texels.data(), 40);
  pool.write(40, texels.data() + 40, 24);
  const GlProgram program(
      gl, "texels",
      "#version 450 core\nvoid main() {\n"
      "  gl_Position = vec4((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1, 0.5, 1);\n}\n",
      "#version 450 core\nlayout(location = 0) out vec4 color;\n"
      "layout(binding = 0) uniform samplerBuffer texels;\n"
      "void main() { color = texelFetch(texels, int(gl_FragCoord.x)); }\n");
  const GlFramebuffer target(gl, 64, 1);
  const GlVertexArray array(gl);
  target.bind();
  target.clear({0, 0, 0, 0});
  program.use();
  array.bind();
  gl.BindTextureUnit(0, pool.texture());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  EXPECT_EQ(target.read_rgba8().pixels, texels);
  check_gl(gl, "texel pool");
}

}  // namespace
}  // namespace viewcell
