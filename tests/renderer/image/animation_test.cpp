// Tests animations by decoding them again.
#include "renderer/image/animation.hpp"

#include <gtest/gtest.h>

#include "base/whole_file.hpp"
#include "tests/renderer/support.hpp"
#include "tests/support/files.hpp"
#include "tests/support/webp_frames.hpp"

namespace renderer::test {
namespace {

// The picture that is shown from `from_ms` (included) to `to_ms` (excluded).
struct Shown {
  int from_ms, to_ms;
  Bitmap bitmap;
};

std::vector<Shown> decode(const std::string& bytes) {
  std::vector<Shown> all;
  for (auto& frame : ::test::decode_webp(bytes))
    all.push_back({frame.from_ms, frame.to_ms, {frame.width, frame.height, std::move(frame.rgb8)}});
  return all;
}

// Makes frames. Each one equals the previous frame except for up to three rectangles.
std::vector<Frame> make_frames(Random& random, int count) {
  const int width = 1 + random.below(60), height = 1 + random.below(60);
  Bitmap bitmap{width, height, std::vector<std::uint8_t>(std::size_t(3 * width * height))};
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) {
    for (int n = random.below(4); n > 0; --n) {
      const int left = random.below(width), top = random.below(height);
      const auto noise = random.below(2);
      for (int y = top; y < height; ++y)
        for (int x = left; x < width; ++x)
          for (int c = 0; c < 3; ++c)
            bitmap.rgb8[std::size_t(3 * (y * width + x) + c)] =
                std::uint8_t(noise ? random.below(256) : 40 * n + c);
    }
    frames.push_back({bitmap, 1 + random.below(500)});
  }
  return frames;
}

TEST(Animation, ShowsTheFramesToTheBit) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const auto frames = make_frames(random, 2 + random.below(7));
    const std::string bytes = make_webp(frames);
    EXPECT_EQ(bytes, make_webp(frames));
    const auto shown = decode(bytes);
    ASSERT_FALSE(shown.empty());
    int time_ms = 0;
    auto now = shown.begin();
    for (const Frame& frame : frames) {
      while (now + 1 != shown.end() && now->to_ms <= time_ms) ++now;
      EXPECT_TRUE(now->bitmap == frame.bitmap) << "at " << time_ms << " ms";
      time_ms += frame.duration_ms;
      // libwebp writes an animation of one picture as a still picture, which has no duration.
      if (shown.size() > 1) {
        EXPECT_GE(now->to_ms, time_ms);
      }
    }
    if (shown.size() > 1) {
      EXPECT_EQ(shown.back().to_ms, time_ms);
    }
  }
}

TEST(Animation, OfOneFrame) {
  const Bitmap bitmap{2, 1, {1, 2, 3, 250, 251, 252}};
  const auto shown = decode(make_webp(std::vector<Frame>{{bitmap, 100}}));
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_EQ(shown[0].bitmap, bitmap);
}

TEST(Animation, SavesWhatItMakes) {
  const std::vector<Frame> frames{{{1, 1, {0, 0, 0}}, 10}, {{1, 1, {255, 0, 0}}, 20}};
  const ::test::TemporaryFolder folder;
  const std::string path = folder.path / "a.webp";
  save_webp(path, frames);
  EXPECT_EQ(base::read_text(path), make_webp(frames));
}

std::string complaint(const std::vector<Frame>& frames) {
  return ::test::message_of<base::BadInput>([&] { make_webp(frames); });
}

TEST(Animation, NamesWhatIsWrong) {
  const Frame good{{1, 1, {0, 0, 0}}, 10};
  EXPECT_EQ(complaint({good, {good.bitmap, 1}}), "");
  EXPECT_EQ(complaint({}), "animation: found no frame, expected 1 or more");
  EXPECT_EQ(complaint({good, {{2, 1, {0, 0, 0, 0, 0, 0}}, 10}}),
            "animation, frame 1: found 2 x 1 pixels, expected 1 x 1, as in the first frame");
  EXPECT_EQ(complaint({good, {good.bitmap, 0}}),
            "animation, frame 1: found a duration of 0 ms, expected 1..16777215");
  EXPECT_EQ(complaint({{{1, 1, {0, 0}}, 10}}),
            "animation, frame 0: found 2 bytes, expected 3 bytes for each of 1 x 1 pixels");
  EXPECT_EQ(complaint({{{16383, 1, std::vector<std::uint8_t>(3 * 16383)}, 10}}), "");
  EXPECT_EQ(complaint({{{1, 16383, std::vector<std::uint8_t>(3 * 16383)}, 10}}), "");
  EXPECT_EQ(complaint({{{16384, 1, std::vector<std::uint8_t>(3 * 16384)}, 10}}),
            "animation: found 16384 x 1 pixels, expected at most 16383 on each side");
  EXPECT_EQ(complaint(std::vector<Frame>(129, {good.bitmap, MAX_DURATION_MS})),
            "animation: found 2164260735 ms together, expected at most 2147483647");
}

}  // namespace
}  // namespace renderer::test
