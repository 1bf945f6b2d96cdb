// Sizes of the kernels' records in simulated memory.
#include "simulator/kernels/kernels.hpp"

#include <gtest/gtest.h>

namespace kernels {
namespace {

TEST(KernelBytes, OfTexturesAreThoseOfAllTheirTexels) {
  const auto model = machine::load_model("t805-25");
  renderer::Scene scene;
  EXPECT_EQ(texture_bytes(model, scene), 0u);
  std::uint64_t texels = 0;
  for (const auto& [width, height] : {std::pair(1, 1), {4, 2}, {7, 5}}) {
    const std::vector<std::uint8_t> rgb8(static_cast<std::size_t>(3 * width * height));
    scene.pyramids.push_back(renderer::make_pyramid(width, height, rgb8));
    texels += texel_count(scene.pyramids.back());
    EXPECT_GE(texels, static_cast<std::uint64_t>(width * height));
    EXPECT_EQ(texture_bytes(model, scene), texels * get_bytes(model, "texel"));
  }
}

}  // namespace
}  // namespace kernels
