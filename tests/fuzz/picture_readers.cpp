// Readers of binary files.
#include <zlib.h>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/picture/refinement_file.hpp"
#include "renderer/files/load_scene.hpp"
#include "renderer/image/image.hpp"
#include "tests/fuzz/kinds.hpp"

namespace fuzz {
namespace {

std::uint32_t get_number(const std::string& text, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = at; i < at + 4; ++i)
    number = number << 8 | static_cast<unsigned char>(text[i]);
  return number;
}

// Replaces the checksums of a PNG file by the right ones, because readers check these first.
std::string mend_checksums(std::string png) {
  constexpr std::size_t SIGNATURE = 8, LENGTH = 4, TYPE = 4, SUM = 4;
  std::size_t at = SIGNATURE;
  while (at + LENGTH + TYPE + SUM <= png.size()) {
    const std::size_t length = get_number(png, at), type = at + LENGTH, sum = type + TYPE + length;
    if (length > png.size() || sum + SUM > png.size()) break;
    const auto mended =
        crc32(0, reinterpret_cast<const Bytef*>(&png[type]), static_cast<uInt>(TYPE + length));
    for (std::size_t i = 0; i < SUM; ++i) png[sum + i] = static_cast<char>(mended >> (24 - 8 * i));
    at = sum + SUM;
  }
  return png;
}

void read_picture(const std::string& text) {
  base::save_whole("fuzz.png", mend_checksums(text));
  const auto bitmap = renderer::load_png("fuzz.png");
  renderer::check(bitmap, "a picture that was read");
  renderer::save_png("again.png", bitmap.width, bitmap.height, bitmap.rgb8);
  const auto again = read_again("PNG", [] { return renderer::load_png("again.png"); });
  expect_same("the picture", again.rgb8, bitmap.rgb8);
}

const laboratory::Identity IDENTITY = {{"version", "fuzz"}, {"scene", "spheres:3"}};

// Reads a state of a rendering, first as it is, and then with the right hash at its end.
void read_state(const std::string& text) {
  using renderer::progressive::Refinement;
  static const auto scene = renderer::load_scene("spheres:3");
  renderer::Params params;
  params.width = 4;
  params.height = 3;
  params.sampling.pixel_samples = 3;
  params.sampling.adaptive = 0.1;
  const auto load = [](const char* path) { return laboratory::load_state(path, IDENTITY, 12); };
  base::save_whole("fuzz.state", text);
  try {
    load("fuzz.state");
    throw Broken("a state without its hash is taken for whole");
  } catch (const base::BadInput&) {
  }
  base::save_whole("fuzz.state", text + laboratory::hash_of(text));
  const auto state = load("fuzz.state");
  laboratory::save_state("again.state", IDENTITY, state);
  expect_same("the state", base::read_text("again.state"), base::read_text("fuzz.state"));
  Refinement image(scene, params, renderer::progressive::Order::quadrants, 1, state);
  while (!image.is_finished()) image.advance(image.total());
  image.make_rendering();
}

}  // namespace

std::vector<Reader> picture_readers() {
  return {
      {"picture", ".png", {"experiments/scenes"}, read_picture},
      {"state", ".state", {}, read_state},
  };
}

}  // namespace fuzz
