// The picture files of `tlab render`: --exposure, --gamma, and OpenEXR.
#include <gtest/gtest.h>

#include "renderer/image/picture.hpp"
#include "renderer/radiosity/show/display.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

using Arguments = std::vector<std::string>;

struct ImageFiles : testing::Test {
  Outcome render(const Arguments& more) {
    Arguments all = {"render", "spheres:60", "--size", "24x18"};
    all.insert(all.end(), more.begin(), more.end());
    return tlab(folder.path, all);
  }
  std::string at(const std::string& name) { return (folder.path / name).string(); }
  TemporaryFolder folder;
};

TEST_F(ImageFiles, TheExrHasTheColoursThatThePngRounds) {
  ASSERT_EQ(render({"-o", "a.png"}).exit_code, 0);
  ASSERT_EQ(render({"-o", "a.exr"}).exit_code, 0);
  const auto linear = renderer::load_exr(at("a.exr"));
  const auto bytes = renderer::load_png(at("a.png"));
  ASSERT_EQ(linear.width, 24);
  EXPECT_EQ(radiosity::make_rgb8(linear, {1, 1}), bytes.rgb8);
  EXPECT_NE(make_picture(bytes), linear);
  ASSERT_EQ(render({"-o", "b.png", "--exposure", "0", "--gamma", "1"}).exit_code, 0);
  EXPECT_EQ(read_file(at("a.png")), read_file(at("b.png")));
}

// A byte is 255 * min(1, 2^exposure * colour) ^ (1 / gamma).
TEST_F(ImageFiles, ExposureAndGammaFollowTheirFormula) {
  ASSERT_EQ(render({"-o", "a.exr"}).exit_code, 0);
  const auto linear = renderer::load_exr(at("a.exr"));
  ASSERT_EQ(render({"-o", "b.png", "--exposure", "1.5", "--gamma", "2.2"}).exit_code, 0);
  const auto found = renderer::load_png(at("b.png")).rgb8;
  int clipped = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& pixel = linear.pixels[i / 3];
    const double light = std::pow(2, 1.5) * (i % 3 == 0 ? pixel.r : i % 3 == 1 ? pixel.g : pixel.b);
    clipped += light > 1;
    EXPECT_NEAR(found[i], 255 * std::pow(std::clamp(light, 0.0, 1.0), 1 / 2.2), 0.501);
  }
  EXPECT_GT(clipped, 0);
}

TEST_F(ImageFiles, EveryKindOfRenderingWritesExr) {
  ASSERT_EQ(render({"-o", "a.exr"}).exit_code, 0);
  const auto whole = read_file(at("a.exr"));
  ASSERT_EQ(render({"-o", "b.exr", "--progressive", "--key-images", "steps"}).exit_code, 0);
  EXPECT_EQ(read_file(at("b.exr")), whole);
  EXPECT_EQ(read_file(at("steps/cell-1.exr")), whole);
  ASSERT_EQ(render({"-o", "c.exr", "--order", "scan", "--key-images", "parts"}).exit_code, 0);
  EXPECT_EQ(read_file(at("c.exr")), whole);
  EXPECT_EQ(read_file(at("parts/percent-100.exr")), whole);
  ASSERT_EQ(render({"-o", "d.exr", "--frames", "0-1"}).exit_code, 0);
  EXPECT_EQ(read_file(at("d-0001.exr")), whole);
  ASSERT_EQ(render({"-o", "e.exr", "--preview", "flat"}).exit_code, 0);
  EXPECT_NE(read_file(at("e.exr")), whole);
}

TEST_F(ImageFiles, EveryKindOfRenderingIsExposed) {
  const Arguments bright = {"--exposure", "1", "--gamma", "2"};
  const auto exposed = [&](const std::string& output, Arguments more) {
    more.insert(more.end(), bright.begin(), bright.end());
    more.insert(more.end(), {"-o", output});
    EXPECT_EQ(render(more).exit_code, 0);
  };
  exposed("a.png", {});
  const auto whole = read_file(at("a.png"));
  exposed("b.png", {"--progressive"});
  exposed("c.png", {"--order", "scan"});
  exposed("d.png", {"--frames", "0-0"});
  for (const char* name : {"b.png", "c.png", "d-0000.png"})
    EXPECT_EQ(read_file(at(name)), whole) << name;
  exposed("w.webp", {"--frames", "0-0"});
  ASSERT_EQ(render({"-o", "v.webp", "--frames", "0-0"}).exit_code, 0);
  EXPECT_NE(read_file(at("w.webp")), read_file(at("v.webp")));
  exposed("p.png", {"--preview", "flat"});
  ASSERT_EQ(render({"-o", "q.png", "--preview", "flat"}).exit_code, 0);
  EXPECT_NE(read_file(at("p.png")), read_file(at("q.png")));
}

TEST_F(ImageFiles, NonsenseIsRefused) {
  const std::pair<Arguments, const char*> cases[] = {
      {{"-o", "a.exr", "--gamma", "1"}, "the colours in an .exr file are linear"},
      {{"-o", "a.exr", "--exposure", "0"}, "the colours in an .exr file are linear"},
      {{"-o", "a.png", "--gamma", "0"}, "--gamma: found 0, expected"},
      {{"-o", "a.png", "--gamma", "nan"}, "--gamma: found nan, expected"},
      {{"-o", "a.png", "--exposure", "40"}, "--exposure: found 40, expected"},
      {{"-o", "a.png", "--exposure", "bright"}, "--exposure: found bright, expected"},
      {{"-o", "a.jpg"}, "ends in .png or .exr"}};
  for (const auto& [arguments, expected] : cases) {
    const auto outcome = render(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << expected;
    EXPECT_TRUE(contains(outcome.err, expected)) << outcome.err;
  }
  EXPECT_TRUE(fs::is_empty(folder.path));
}

}  // namespace
}  // namespace laboratory
