// Decodes the frames of an animated WebP file with the library libwebp.
#pragma once

#include <gtest/gtest.h>
#include <webp/demux.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace test {

// A frame, shown from `from_ms` up to, but not including, `to_ms`.
struct WebpFrame {
  int from_ms, to_ms, width, height;
  std::vector<std::uint8_t> rgb8;  // pixels, in rows from the top

  std::vector<int> pixel(double x, double y) const {
    const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x));
    return {rgb8.at(at), rgb8.at(at + 1), rgb8.at(at + 2)};
  }
};

// Decodes all frames; empty if `bytes` is not an animated WebP file.
inline std::vector<WebpFrame> decode_webp(const std::string& bytes) {
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
  const std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> decoder(
      WebPAnimDecoderNew(&data, nullptr), &WebPAnimDecoderDelete);
  WebPAnimInfo info;
  if (!decoder || !WebPAnimDecoderGetInfo(decoder.get(), &info)) return {};
  std::vector<WebpFrame> all;
  int before = 0;
  while (WebPAnimDecoderHasMoreFrames(decoder.get())) {
    std::uint8_t* rgba = nullptr;
    int end = 0;
    if (!WebPAnimDecoderGetNext(decoder.get(), &rgba, &end)) return {};
    WebpFrame shown{
        before, end, static_cast<int>(info.canvas_width), static_cast<int>(info.canvas_height), {}};
    for (std::size_t i = 0; i < std::size_t{info.canvas_width} * info.canvas_height; ++i) {
      EXPECT_EQ(rgba[4 * i + 3], 255);
      shown.rgb8.insert(shown.rgb8.end(), rgba + 4 * i, rgba + 4 * i + 3);
    }
    all.push_back(std::move(shown));
    before = end;
  }
  return all;
}

}  // namespace test
