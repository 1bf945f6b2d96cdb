// Tests the conversion of radiosity to bytes and picture files.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gtest/gtest.h>
#include <png.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <system_error>

#include "renderer/radiosity/show/display.hpp"
#include "tests/renderer/support.hpp"

namespace radiosity::test {
namespace {

struct TemporaryFolder {
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tlab-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error(name);
    path = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(path))
      found.insert(entry.path().filename().string());
    return found;
  }

  std::filesystem::path path;
};

constexpr double INFINITE = std::numeric_limits<double>::infinity();

Picture make_random_picture(std::uint64_t seed = 3) {
  renderer::test::Random random{seed};
  Picture picture{31, 17, {}};
  for (int i = 0; i < 31 * 17; ++i)
    picture.pixels.push_back(std::pow(10, random.range(-3, 1)) * random.colour());
  return picture;
}

TEST(Display, BytesAreThePowerOfTheExposedLight) {
  const Picture picture{2, 1, {{0.5, 2, -1}, {0.1, std::nan(""), INFINITE}}};
  EXPECT_EQ(make_rgb8(picture, {1, 1}), (std::vector<std::uint8_t>{128, 255, 0, 26, 0, 255}));
  EXPECT_EQ(make_rgb8(picture, {0.5, 1}), (std::vector<std::uint8_t>{64, 255, 0, 13, 0, 255}));
  // 255 * sqrt(0.5) = 180.3 and 255 * sqrt(0.1) = 80.6
  EXPECT_EQ(make_rgb8(picture, {1, 2}), (std::vector<std::uint8_t>{180, 255, 0, 81, 0, 255}));
}

TEST(Display, ExposureCutsOffTheShareThatIsLeft) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Picture picture = make_random_picture(seed);
    for (const double share : {0.0, 0.3, 0.5, 0.99, 1.0}) {
      const double exposure = find_exposure(picture, {}, share);
      int above = 0, white = 0;
      for (const Rgb& pixel : picture.pixels) {
        const double light = exposure * max_component(pixel);
        above += light > 1 + 1e-12;
        white += std::abs(light - 1) <= 1e-12;
      }
      EXPECT_GE(white, 1) << "seed " << seed;
      const int last = std::max(1, static_cast<int>(std::ceil(share * 31 * 17)));
      EXPECT_EQ(above, 31 * 17 - last) << "seed " << seed << " share " << share;
    }
  }
  EXPECT_EQ(find_exposure({2, 1, {{}, {}}}), 1);
  EXPECT_EQ(find_exposure({2, 1, {{}, {0, 4, 1}}}, {}, 0.5), 0.25);
}

TEST(Display, DifferencesAreNeverNegative) {
  const Picture a{2, 1, {{1, 2, 3}, {0, 0, 0.5}}}, b{2, 1, {{2, 0, 3}, {0.25, 0, 0}}};
  const Picture expected{2, 1, {{4, 8, 0}, {1, 0, 2}}};
  EXPECT_EQ(make_difference(a, b, 4), expected);
  EXPECT_EQ(make_difference(b, a, 4), expected);
  EXPECT_THROW(make_difference(a, {1, 2, {{}, {}}}), base::BadInput);
}

TEST(Exr, ReadsBackEqual) {
  const TemporaryFolder folder;
  Picture picture = make_random_picture();
  picture.pixels[5] = {1e300, -1e300, 1e-300};
  const auto path = (folder.path / "a.exr").string();
  save_exr(path, picture);
  Imf::InputFile file(path.c_str());
  const auto& header = file.header();
  ASSERT_EQ(header.dataWindow().max.x, 30);
  ASSERT_EQ(header.dataWindow().max.y, 16);
  std::vector<float> floats(3 * picture.pixels.size());
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string name(1, "RGB"[c]);
    ASSERT_NE(header.channels().findChannel(name), nullptr);
    EXPECT_EQ(header.channels().findChannel(name)->type, Imf::FLOAT);
    frame.insert(name,
                 Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(floats.data() + c), 12, 12 * 31));
  }
  file.setFrameBuffer(frame);
  file.readPixels(0, 16);
  constexpr float MOST = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    if (i == 5) continue;
    EXPECT_EQ(floats[3 * i], static_cast<float>(picture.pixels[i].r));
    EXPECT_EQ(floats[3 * i + 1], static_cast<float>(picture.pixels[i].g));
    EXPECT_EQ(floats[3 * i + 2], static_cast<float>(picture.pixels[i].b));
  }
  EXPECT_EQ(floats[15], MOST);
  EXPECT_EQ(floats[16], -MOST);
  EXPECT_EQ(floats[17], 0);
  Picture expected{31, 17, {}};
  for (std::size_t i = 0; i < floats.size(); i += 3)
    expected.pixels.push_back({floats[i], floats[i + 1], floats[i + 2]});
  EXPECT_EQ(renderer::load_exr(path), expected);
}

// The rectangle of stored pixels need not begin at (0, 0), and channels may have 16 bits.
TEST(Exr, ReadsAWindowOfHalfFloats) {
  const TemporaryFolder folder;
  const auto path = (folder.path / "a.exr").string();
  Imf::Header header({{0, 0}, {99, 99}}, {{7, -3}, {8, -2}});
  std::vector<Imath::half> values = {1, 2, 3, 4};
  Imf::FrameBuffer frame;
  for (const char* name : {"R", "G", "B"}) {
    header.channels().insert(name, Imf::Channel(Imf::HALF));
    const auto first = reinterpret_cast<std::uintptr_t>(values.data()) - 2u * (7 - 3 * 2);
    frame.insert(name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(first), 2, 4));
  }
  {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(2);
  }
  EXPECT_EQ(renderer::load_exr(path),
            (Picture{2, 2, {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}}}));
}

TEST(Exr, RefusesWhatIsNoPicture) {
  const TemporaryFolder folder;
  const auto path = (folder.path / "a.exr").string();
  const auto problem = [&]() -> std::string {
    try {
      renderer::load_exr(path);
      return "none";
    } catch (const base::BadInput& bad) {
      return bad.what();
    }
  };
  EXPECT_NE(problem().find("cannot be read"), std::string::npos);
  std::ofstream(path) << "no picture";
  EXPECT_NE(problem().find("not a complete OpenEXR picture"), std::string::npos);
  renderer::save_exr(path, make_random_picture());
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 100);
  EXPECT_NE(problem().find("not a complete OpenEXR picture"), std::string::npos);
  Imf::Header grey(1, 1);
  grey.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  float value = 1;
  Imf::FrameBuffer frame;
  frame.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&value), 4, 4));
  {
    Imf::OutputFile file(path.c_str(), grey);
    file.setFrameBuffer(frame);
    file.writePixels(1);
  }
  EXPECT_NE(problem().find("found no channel R"), std::string::npos);
}

TEST(RadiosityPng, ReadsBackEqual) {
  const TemporaryFolder folder;
  const Picture picture = make_random_picture();
  const auto path = (folder.path / "a.png").string();
  save_png(path, picture, {0.7, 2.2});
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&image, path.c_str()));
  EXPECT_EQ(image.width, 31u);
  EXPECT_EQ(image.height, 17u);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(image));
  ASSERT_TRUE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr));
  EXPECT_EQ(bytes, make_rgb8(picture, {0.7, 2.2}));
}

using Save = std::function<void(const std::string&, const Picture&)>;

class PictureFiles : public testing::TestWithParam<Save> {};

TEST_P(PictureFiles, SamePictureSameBytesAndNothingLeftBeside) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return (folder.path / name).string(); };
  const auto read = [&](const char* name) {
    std::ifstream in(at(name), std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  GetParam()(at("a"), make_random_picture());
  std::ofstream(at("b")) << "something older";
  GetParam()(at("b"), make_random_picture());
  EXPECT_GT(read("a").size(), 100u);
  EXPECT_EQ(read("a"), read("b"));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"a", "b"}));
}

TEST_P(PictureFiles, WhatCannotBeWrittenIsAnError) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return (folder.path / name).string(); };
  const Picture picture = make_random_picture();
  EXPECT_THROW(GetParam()(at("no/such/folder"), picture), std::system_error);
  std::filesystem::create_directory(at("folder"));
  EXPECT_THROW(GetParam()(at("folder"), picture), std::system_error);
  EXPECT_THROW(GetParam()(at("a"), Picture()), base::BadInput);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"folder"}));
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  try {
    GetParam()("/dev/full", picture);
    ADD_FAILURE() << "written to a full device";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), ENOSPC);
    EXPECT_NE(std::string(error.what()).find("/dev/full: cannot be written"), std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::is_regular_file("/dev/full"));
}

INSTANTIATE_TEST_SUITE_P(Formats, PictureFiles,
                         testing::Values(Save(renderer::save_exr),
                                         Save([](const std::string& path, const Picture& picture) {
                                           save_png(path, picture, {1, 2.2});
                                         })));

TEST(RadiosityPng, TakesPositiveNumbersOnly) {
  const TemporaryFolder folder;
  const auto path = (folder.path / "a.png").string();
  for (const Display& bad : {Display{0, 1}, Display{-1, 1}, Display{INFINITE, 1}, Display{1, 0},
                             Display{1, std::nan("")}})
    EXPECT_THROW(save_png(path, make_random_picture(), bad), base::BadInput);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace radiosity::test
