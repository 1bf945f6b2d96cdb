// Fixed point and files.

#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

TEST(Samples, AnyOrderGivesTheSameBits) {
  Random random{1};
  std::vector<Rgb> contributions;
  for (int i = 0; i < 1000; ++i)
    contributions.push_back(std::pow(10, random.range(-12, 2)) * random.colour());
  Samples first(1, 1);
  for (const Rgb& c : contributions) first.add(0, c);
  for (int round = 0; round < 20; ++round) {
    for (std::size_t i = contributions.size(); i > 1; --i)
      std::swap(contributions[i - 1],
                contributions[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
    Samples some(1, 1), rest(1, 1);
    for (std::size_t i = 0; i < contributions.size(); ++i)
      (i % 3 == 0 ? some : rest).add(0, contributions[i]);
    EXPECT_EQ(some += rest, first);
  }
}

TEST(Samples, OneContributionIsLimited) {
  constexpr double INF = std::numeric_limits<double>::infinity();
  Samples samples(1, 1);
  samples.add(0, {INF, -INF, std::nan("")});
  EXPECT_EQ(samples.get(0), (Rgb{1024, -1024, 0}));
  for (int i = 0; i < 10; ++i) samples.add(0, {1e300, 0, 0});
  EXPECT_EQ(samples.get(0).r, 11 * 1024);
}

TEST(Samples, Bytes) {
  Samples samples(2, 1);
  samples.add(0, {0.5, 1, 2});
  samples.add(1, {-1, 1.0 / 255, 0.999});
  EXPECT_EQ(make_rgb8(samples), (std::vector<std::uint8_t>{128, 255, 255, 0, 1, 255}));
}

class Png : public testing::Test {
 protected:
  Png() { std::filesystem::create_directories(folder_); }
  ~Png() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static std::string read(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::ptrdiff_t files() const {
    return std::distance(std::filesystem::directory_iterator(folder_), {});
  }
  static Samples make_image() {
    Random random{3};
    Samples samples(31, 17);
    for (std::uint32_t i = 0; i < 31 * 17; ++i) samples.add(i, random.colour());
    return samples;
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("tlab-png-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "-" +
       ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Png, ReadsBackEqual) {
  const Samples samples = make_image();
  save_png(path("a.png"), samples);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&image, path("a.png").c_str()));
  EXPECT_EQ(image.width, 31u);
  EXPECT_EQ(image.height, 17u);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(image));
  ASSERT_TRUE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr));
  EXPECT_EQ(bytes, make_rgb8(samples));
}

TEST_F(Png, SameSamplesSameBytesAndNothingLeftBeside) {
  save_png(path("a.png"), make_image());
  std::ofstream(path("b.png")) << "something older";
  save_png(path("b.png"), make_image());
  EXPECT_EQ(read(path("a.png")), read(path("b.png")));
  EXPECT_EQ(files(), 2);
}

TEST_F(Png, WhatCannotBeWrittenIsAnError) {
  EXPECT_THROW(save_png(path("no/such/folder.png"), make_image()), std::system_error);
  std::filesystem::create_directory(path("folder"));
  EXPECT_THROW(save_png(path("folder"), make_image()), std::system_error);
  EXPECT_THROW(save_png(path("a.png"), Samples()), base::BadInput);
  EXPECT_EQ(files(), 1);
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  try {
    save_png("/dev/full", make_image());
    ADD_FAILURE() << "written to a full device";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), ENOSPC);
    EXPECT_NE(std::string(error.what()).find("/dev/full: cannot be written"), std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::is_regular_file("/dev/full"));
}

}  // namespace
}  // namespace renderer::test
