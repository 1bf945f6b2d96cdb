#include "renderer/image/animation.hpp"

#include <webp/encode.h>
#include <webp/mux.h>

#include <memory>

#include "base/whole_file.hpp"
#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr const char* WHO = "animation";

void check_frames(std::span<const Frame> frames) {
  require(!frames.empty(), WHO, "no frame", "1 or more");
  const Bitmap& first = frames[0].bitmap;
  check(first, WHO);
  require(first.width <= MAX_WEBP_SIDE && first.height <= MAX_WEBP_SIDE, WHO,
          fmt::format("{} x {} pixels", first.width, first.height),
          fmt::format("at most {} along each side", MAX_WEBP_SIDE));
  std::int64_t time_ms = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto& [bitmap, duration_ms] = frames[i];
    const std::string who = fmt::format("{}, frame {}", WHO, i);
    check(bitmap, who);
    require(bitmap.width == first.width && bitmap.height == first.height, who,
            fmt::format("{} x {} pixels", bitmap.width, bitmap.height),
            fmt::format("{} x {} as the first", first.width, first.height));
    require(duration_ms >= 1 && duration_ms <= MAX_DURATION_MS, who,
            fmt::format("a duration of {} ms", duration_ms), fmt::format("1..{}", MAX_DURATION_MS));
    time_ms += duration_ms;
  }
  constexpr int MOST = std::numeric_limits<int>::max();
  require(time_ms <= MOST, WHO, fmt::format("{} ms together", time_ms),
          fmt::format("at most {}", MOST));
}

// A call of libwebp, which fails for want of memory only: what it may refuse has been checked.
void expect(bool done, const char* call) {
  if (!done) throw std::runtime_error(fmt::format("{}: libwebp: {} failed", WHO, call));
}

// libwebp's structures, which end with their scope.
struct Picture : WebPPicture {
  explicit Picture(const Bitmap& bitmap) {
    expect(WebPPictureInit(this), "WebPPictureInit");
    use_argb = 1;
    width = bitmap.width;
    height = bitmap.height;
    expect(WebPPictureImportRGB(this, bitmap.rgb8.data(), 3 * bitmap.width),
           "WebPPictureImportRGB");
  }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  ~Picture() { WebPPictureFree(this); }
};

struct Data : WebPData {
  Data() { WebPDataInit(this); }
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;
  ~Data() { WebPDataClear(this); }
};

using Encoder = std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)>;

Encoder make_encoder(int width, int height) {
  WebPAnimEncoderOptions options;
  expect(WebPAnimEncoderOptionsInit(&options), "WebPAnimEncoderOptionsInit");
  options.anim_params.loop_count = 0;
  Encoder encoder(WebPAnimEncoderNew(width, height, &options), &WebPAnimEncoderDelete);
  expect(encoder != nullptr, "WebPAnimEncoderNew");
  return encoder;
}

}  // namespace

std::string make_webp(std::span<const Frame> frames) {
  check_frames(frames);
  WebPConfig config;
  expect(WebPConfigInit(&config), "WebPConfigInit");
  config.lossless = 1;
  config.quality = 25;  // effort, of a lossless file
  config.thread_level = 0;

  const Encoder encoder = make_encoder(frames[0].bitmap.width, frames[0].bitmap.height);
  int time_ms = 0;
  for (const Frame& frame : frames) {
    Picture picture(frame.bitmap);
    expect(WebPAnimEncoderAdd(encoder.get(), &picture, time_ms, &config), "WebPAnimEncoderAdd");
    time_ms += frame.duration_ms;
  }
  expect(WebPAnimEncoderAdd(encoder.get(), nullptr, time_ms, nullptr), "WebPAnimEncoderAdd");
  Data data;
  expect(WebPAnimEncoderAssemble(encoder.get(), &data), "WebPAnimEncoderAssemble");
  return {reinterpret_cast<const char*>(data.bytes), data.size};
}

void save_webp(const std::string& path, std::span<const Frame> frames) {
  base::save_whole(path, make_webp(frames));
}

}  // namespace renderer
