// tlab render: samples per pixel, maps of samples, and frames of an animation.
#include <gtest/gtest.h>

#include "tests/laboratory/support/tlab.hpp"
#include "tests/support/webp.hpp"

namespace laboratory {
namespace {

using Arguments = std::vector<std::string>;

const std::string SCENE =
    "# shutter 0 0.5\n# lens 0.3 5\nv from 0 0 5 at 0 0 0 up 0 1 0 angle 40\nl 5 5 5\n"
    "f 1 0.5 0.2 0.8 0.2 9 0 0\n# path way.csv\ns 0 0 0 0.5\n# move 0 0 0\ns 1 1 0 0.4\n";

// A folder with an animated scene of three frames, in which a sphere moves to the right.
struct SceneFolder : TemporaryFolder {
  SceneFolder() {
    write("s.nff", SCENE);
    write("way.csv", "0,-1,0,0\n3,1,0,0\n");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
  }
  Outcome render(const Arguments& more) const {
    Arguments all = {"render", "s.nff"};
    if (std::ranges::find(more, "--size") == more.end()) all.insert(all.end(), {"--size", "24x18"});
    all.insert(all.end(), more.begin(), more.end());
    return tlab(path, all);
  }
  bool has(const std::string& name) const { return std::filesystem::exists(path / name); }
};

TEST(DistributedCommand, OptionsOfSamplesChangeTheImage) {
  const SceneFolder folder;
  const auto image_of = [&](const Arguments& more) {
    Arguments all = {"-o", "i.png"};
    all.insert(all.end(), more.begin(), more.end());
    const auto outcome = folder.render(all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return read_file(folder.path / "i.png");
  };
  const auto image = image_of({"--pixel-samples", "9"});
  EXPECT_EQ(image_of({"--pixel-samples", "9", "--threads", "3"}), image);
  for (const Arguments& other : {Arguments{"--pixel-samples", "8"},
                                 {"--pixel-samples", "9", "--lens", "0"},
                                 {"--pixel-samples", "9", "--shutter", "0"},
                                 {"--pixel-samples", "9", "--sample-seed", "2"},
                                 {"--pixel-samples", "20", "--adaptive", "0.1"}})
    EXPECT_NE(image_of(other), image) << other.back();
}

TEST(DistributedCommand, TheMapOfSamplesIsAPicture) {
  const SceneFolder folder;
  ASSERT_EQ(folder
                .render({"-o", "i.png", "--pixel-samples", "64", "--adaptive", "0.02",
                         "--samples-map", "m.png"})
                .exit_code,
            0);
  EXPECT_EQ(read_file(folder.path / "m.png").substr(1, 3), "PNG");
  EXPECT_NE(read_file(folder.path / "m.png"), read_file(folder.path / "i.png"));
  const auto alone = folder.render({"-o", "j.png", "--samples-map", "n.png"});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.err.find("--samples-map: expected --adaptive"), std::string::npos) << alone.err;
  EXPECT_FALSE(folder.has("j.png"));
}

TEST(DistributedCommand, FramesAreImagesAndAnAnimation) {
  const SceneFolder folder;
  const auto outcome =
      folder.render({"-o", "a.webp", "--frames", "1-3", "--pixel-samples", "2", "--threads", "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* name : {"a-0001.png", "a-0002.png", "a-0003.png"})
    EXPECT_TRUE(folder.has(name)) << name;
  EXPECT_FALSE(folder.has("a-0000.png"));
  EXPECT_FALSE(folder.has("a-0004.png"));
  const auto animation = read_file(folder.path / "a.webp");
  EXPECT_EQ(animation.substr(0, 4), "RIFF");
  // At 30 frames per second, the durations are rounded to whole ms, but their sum is exact.
  ASSERT_EQ(
      folder
          .render({"-o", "c.webp", "--frames", "1-3", "--frame-rate", "30", "--pixel-samples", "2"})
          .exit_code,
      0);
  EXPECT_EQ(test::durations_of_webp(read_file(folder.path / "c.webp")), (std::vector{33, 34, 33}));
  EXPECT_NE(read_file(folder.path / "a-0001.png"), read_file(folder.path / "a-0002.png"));

  // A frame does not depend on earlier frames. Frame 0 equals the image rendered without --frames.
  ASSERT_EQ(folder.render({"-o", "b.png", "--frames", "0-2", "--pixel-samples", "2"}).exit_code, 0);
  EXPECT_EQ(read_file(folder.path / "b-0002.png"), read_file(folder.path / "a-0002.png"));
  ASSERT_EQ(folder.render({"-o", "c.png", "--pixel-samples", "2"}).exit_code, 0);
  EXPECT_EQ(read_file(folder.path / "b-0000.png"), read_file(folder.path / "c.png"));
  EXPECT_FALSE(folder.has("b.png"));
}

TEST(DistributedCommand, WrongFramesAreRefusedBeforeAnythingIsWritten) {
  const SceneFolder folder;
  const auto files = [&] {
    return std::distance(std::filesystem::directory_iterator(folder.path), {});
  };
  const auto before = files();
  const auto expect = [&](const Arguments& more, const std::string& error) {
    const auto outcome = folder.render(more);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(error), std::string::npos) << outcome.err;
    EXPECT_EQ(files(), before);
  };
  for (const char* range : {"3-1", "-1", "2", "a-b", "0-", "0-1000000", "1-2-3", "0--1"})
    expect({"-o", "a.png", "--frames", range}, "--frames");
  expect({"-o", "a.png", "--frame-rate", "10"}, "--frame-rate requires --frames");
  expect({"-o", "a.webp", "--frames", "0-1", "--frame-rate", "0"}, "--frame-rate");
  expect({"-o", "a.webp", "--frames", "0-1", "--frame-rate", "nan"}, "--frame-rate: found nan");
  expect({"-o", "a.webp"}, "expected a name that ends in .png");
  expect({"-o", "a.gif", "--frames", "0-1"}, "expected a name that ends in .png or .exr or .webp");
  expect({"-o", "a.png", "--frames", "0-1", "--progressive"}, "--progressive excludes --frames");
  expect({"-o", "a.png", "--pixel-samples", "4", "--progressive"},
         "--pixel-samples excludes --progressive");
  expect({"-o", "a.png", "--adaptive", "0.1", "--preview", "flat"},
         "--adaptive excludes --preview");
  expect({"-o", "a.webp", "--frames", "0-1", "--size", "20000x1"}, "at most 16383 pixels");
  // The frames of an animation take at most 2^31 bytes, with 3 for each pixel.
  expect({"-o", "a.webp", "--frames", "0-99999", "--size", "4096x2048"},
         "found 100000 frames of 4096 x 2048 pixels, expected at most 85");
  // Only in frame 2 is the view impossible.
  folder.write("way.csv", "0 0 0 5 0 0 0\n2 0 0 0 0 0 0\n4 0 0 5 0 0 0\n");
  folder.write("s.nff", "# camera way.csv\n" + SCENE.substr(0, SCENE.find("# path")));
  expect({"-o", "a.png", "--frames", "0-4"}, "s.nff:1: found a view from the point it looks at");
}

}  // namespace
}  // namespace laboratory
