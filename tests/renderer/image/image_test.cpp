// Tests images in fixed point, and picture files.

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

// With libpng, writes a PNG file whose header states `width` and `height`. The file has only one
// row of pixels. If `height` is greater than 1, the rest of the file is invalid.
void save_row(const std::string& path, int width, int height, int bits, int type,
              const std::vector<std::uint8_t>& row) {
  FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), bits,
               type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if (height == 1) {
    png_write_row(png, row.data());
    png_write_end(png, info);
  } else {
    png_write_chunk(png, reinterpret_cast<png_const_bytep>("IDAT"), row.data(), row.size());
  }
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

TEST_F(Png, LoadsWhatItSaved) {
  const Samples samples = make_image();
  save_png(path("a.png"), samples);
  EXPECT_EQ(load_png(path("a.png")), make_bitmap(samples));
}

TEST_F(Png, LoadsAnyKind) {
  using Bytes = std::vector<std::uint8_t>;
  const auto load = [&](int bits, int type, const Bytes& row) {
    save_row(path("a.png"), 1, 1, bits, type, row);
    const Bitmap found = load_png(path("a.png"));
    EXPECT_EQ(found.width * found.height, 1);
    return found.rgb8;
  };
  EXPECT_EQ(load(8, PNG_COLOR_TYPE_RGB, {1, 128, 255}), (Bytes{1, 128, 255}));
  EXPECT_EQ(load(8, PNG_COLOR_TYPE_GRAY, {77}), (Bytes{77, 77, 77}));
  EXPECT_EQ(load(1, PNG_COLOR_TYPE_GRAY, {0x80}), (Bytes{255, 255, 255}));
  EXPECT_EQ(load(16, PNG_COLOR_TYPE_RGB, {0, 0, 0x80, 0x80, 255, 255}), (Bytes{0, 128, 255}));
  // Opaque pixels keep their colour; transparent ones become white.
  EXPECT_EQ(load(8, PNG_COLOR_TYPE_RGB_ALPHA, {9, 8, 7, 255}), (Bytes{9, 8, 7}));
  EXPECT_EQ(load(8, PNG_COLOR_TYPE_GRAY_ALPHA, {9, 0}), (Bytes{255, 255, 255}));
}

TEST_F(Png, WhatCannotBeLoadedIsAnErrorThatNamesTheFile) {
  const std::string file = path("a.png");
  const auto refused = [&](std::string_view bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      load_png(file);
      return std::string("no error");
    } catch (const base::BadInput& error) {
      return std::string(error.what());
    }
  };
  const auto names = [&](const std::string& message) {
    return message.starts_with(file + ": found ") && message.ends_with(", expected a picture");
  };
  EXPECT_PRED1(names, refused(""));
  EXPECT_PRED1(names, refused("P6 1 1 255 abc"));
  save_png(file, make_image());
  const std::string whole = read(file);
  // (The last 12 bytes of a PNG are its end marker, which may be missing.)
  for (std::size_t size = 0; size + 12 < whole.size(); size += 37)
    EXPECT_PRED1(names, refused(whole.substr(0, size))) << size;
  // Changed bytes must give an error or a picture, but never a crash.
  Random random{8};
  for (int i = 0; i < 300; ++i) {
    std::string bytes = whole;
    const auto at = static_cast<std::size_t>(random.below(static_cast<int>(whole.size())));
    bytes[at] = static_cast<char>(random.below(256));
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      const Bitmap found = load_png(file);
      EXPECT_EQ(found.rgb8.size(), std::size_t{3} * static_cast<unsigned>(found.width) *
                                       static_cast<unsigned>(found.height));
    } catch (const base::BadInput& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(file));
    }
  }
  EXPECT_THROW(load_png(path("none.png")), base::BadInput);
  EXPECT_THROW(load_png(path("")), base::BadInput);  // a folder instead of a file
}

TEST_F(Png, TooManyPixelsAreAnError) {
  const std::string file = path("a.png");
  save_row(file, 4097, 4096, 8, PNG_COLOR_TYPE_GRAY, std::vector<std::uint8_t>(4097));
  try {
    load_png(file);
    ADD_FAILURE() << "loaded";
  } catch (const base::BadInput& error) {
    EXPECT_EQ(error.what(), file + ": found 4097 x 4096 pixels, expected at most 16777216 pixels");
  }
}

}  // namespace
}  // namespace renderer::test
