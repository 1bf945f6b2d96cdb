// Tests form factors that are cached from one shot of a patch to the next.

#include "renderer/radiosity/light/rows.hpp"

#include <gtest/gtest.h>

#include "renderer/radiosity/light/solve.hpp"
#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

// A room in which a path of light can meet up to three mirrors.
Mesh make_mirrored(Random& random, std::uint64_t seed) {
  Room room = make_furnished(random, 2, 1 + static_cast<int>(seed % 3));
  if (seed % 4) {
    room.materials.push_back({"mirror", {0.9, 0.8, 0.7}, {}, true});
    const auto mirror = static_cast<std::uint32_t>(room.materials.size() - 1);
    add_quad(room, mirror, {0.3, 0.3, 0.9}, {1.2, 0, 0}, {0, 1.2, 0});
    add_quad(room, mirror, {0.3, 1.5, 0.1}, {1.2, 0, 0}, {0, 0, 0.7});
    add_quad(room, mirror, {0.2, 0.3, 0.1}, {0, 1.2, 0}, {0, 0, 0.7});
  }
  return make_mesh(room, {});
}

// Later shots of a patch, with another radiosity, must equal those without the cache bit for bit.
// This must also be true if there is memory for some patches only.
TEST(Rows, GiveWhatRaysGive) {
  std::size_t over_mirrors = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Mesh mesh = make_mirrored(random, seed);
    FactorParams params{.reflections = 3};
    if (seed % 3 == 0) params.mirror_pieces = 4;
    if (seed % 5 == 0) params.samples = 2;
    if (seed % 7 == 0) params.traversal = renderer::Traversal::exhaustive;
    const Eye eye{mesh, params};
    std::size_t room = seed % 2 ? std::size_t{1} << 30 : 100'000, most = room;
    Rows rows(eye, mesh.vertices, room);
    const auto vertices = all_vertices(mesh);
    for (int i = 0; i < 40; ++i) {
      const auto p = static_cast<std::uint32_t>(random.below(10));
      const Patch& patch = mesh.patches[p];
      const Sender sender(
          patch, i % 3 ? Glow({random.colour(), random.colour(), random.colour(), random.colour()})
                       : Glow(random.colour()));
      Work kept, cast;
      State state = make_state(mesh, Sends::mean);
      receive(eye, sender, vertices, state, cast);
      const auto lights = rows.eval(p, sender, kept);
      kept[renderer::Op::vertex_lit] += vertices.size();
      ASSERT_EQ(std::vector<Rgb>(lights.begin(), lights.end()), state.received) << i;
      ASSERT_EQ(kept, cast) << i;
      over_mirrors += cast[renderer::Op::light_mirrored];
    }
    EXPECT_EQ(room < most, params.traversal == renderer::Traversal::nearest);
    EXPECT_EQ(room == 0, seed % 2 == 0 && room < most);
  }
  EXPECT_GT(over_mirrors, 100'000u);
}

}  // namespace
}  // namespace radiosity::test
