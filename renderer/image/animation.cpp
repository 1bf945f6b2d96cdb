#include "renderer/image/animation.hpp"

#include <webp/encode.h>
#include <webp/mux.h>

#include <limits>
#include <memory>
#include <optional>

#include "base/whole_file.hpp"
#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr const char* WHO = "animation";

// Checks the frames of an animation one after the other.
class FrameCheck {
 public:
  void check(const Frame& frame) {
    const auto& [bitmap, duration_ms] = frame;
    const std::string who = fmt::format("{}, frame {}", WHO, count_);
    renderer::check(bitmap, who);
    if (count_++ == 0) {
      width_ = bitmap.width, height_ = bitmap.height;
      require(width_ <= MAX_WEBP_SIDE && height_ <= MAX_WEBP_SIDE, WHO,
              fmt::format("{} x {} pixels", width_, height_),
              fmt::format("at most {} on each side", MAX_WEBP_SIDE));
    }
    require(bitmap.width == width_ && bitmap.height == height_, who,
            fmt::format("{} x {} pixels", bitmap.width, bitmap.height),
            fmt::format("{} x {}, as in the first frame", width_, height_));
    require(duration_ms >= 1 && duration_ms <= MAX_DURATION_MS, who,
            fmt::format("a duration of {} ms", duration_ms), fmt::format("1..{}", MAX_DURATION_MS));
    time_ms_ += duration_ms;
    constexpr int MOST = std::numeric_limits<int>::max();
    require(time_ms_ <= MOST, WHO, fmt::format("{} ms together", time_ms_),
            fmt::format("at most {}", MOST));
  }

 private:
  std::size_t count_ = 0;
  int width_ = 0, height_ = 0;
  std::int64_t time_ms_ = 0;
};

// Throws std::runtime_error if a call of libwebp failed. The input has been checked, so that only a
// lack of memory can be the reason.
void expect(bool done, const char* call) {
  if (!done) throw std::runtime_error(fmt::format("{}: libwebp: {} failed", WHO, call));
}

// Structures of libwebp that free their memory in the destructor.
struct EncodedPicture : WebPPicture {
  explicit EncodedPicture(const Bitmap& bitmap) {
    expect(WebPPictureInit(this), "WebPPictureInit");
    use_argb = 1;
    width = bitmap.width;
    height = bitmap.height;
    expect(WebPPictureImportRGB(this, bitmap.rgb8.data(), 3 * bitmap.width),
           "WebPPictureImportRGB");
  }
  EncodedPicture(const EncodedPicture&) = delete;
  EncodedPicture& operator=(const EncodedPicture&) = delete;
  ~EncodedPicture() { WebPPictureFree(this); }
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

std::string make_webp(std::size_t count, const MakeFrame& make) {
  require(count > 0, WHO, "no frame", "1 or more");
  WebPConfig config;
  expect(WebPConfigInit(&config), "WebPConfigInit");
  config.lossless = 1;
  config.quality = 25;  // for lossless files, the effort of the encoder
  config.thread_level = 0;

  FrameCheck check;
  std::optional<Encoder> encoder;
  int time_ms = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Frame frame = make(i);
    check.check(frame);
    if (!encoder) encoder = make_encoder(frame.bitmap.width, frame.bitmap.height);
    EncodedPicture picture(frame.bitmap);
    expect(WebPAnimEncoderAdd(encoder->get(), &picture, time_ms, &config), "WebPAnimEncoderAdd");
    time_ms += frame.duration_ms;
  }
  expect(WebPAnimEncoderAdd(encoder->get(), nullptr, time_ms, nullptr), "WebPAnimEncoderAdd");
  Data data;
  expect(WebPAnimEncoderAssemble(encoder->get(), &data), "WebPAnimEncoderAssemble");
  return {reinterpret_cast<const char*>(data.bytes), data.size};
}

std::string make_webp(std::span<const Frame> frames) {
  return make_webp(frames.size(), [&](std::size_t i) { return frames[i]; });
}

void save_webp(const std::string& path, std::span<const Frame> frames) {
  base::save_whole(path, make_webp(frames));
}

}  // namespace renderer
