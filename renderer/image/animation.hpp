#pragma once
// Animated WebP files from a sequence of pictures.

#include <functional>
#include <span>
#include <string>

#include "renderer/image/image.hpp"

namespace renderer {

struct Frame {
  Bitmap bitmap;
  int duration_ms = 1;  ///< how long it is shown, 1..MAX_DURATION_MS
};

inline constexpr int MAX_DURATION_MS = (1 << 24) - 1;
inline constexpr int MAX_WEBP_SIDE = 16383;  ///< pixels

/// The bytes of a lossless WebP file that repeats for ever and shows the frames' exact pixels.
/// Equal consecutive frames may be merged, with their total duration. The bytes depend only on the
/// frames and on libwebp's version: no date, no text, no threads. BadInput for no frame, frames of
/// unequal or too large sizes, a duration out of range, and more than 2^31 - 1 ms in total.
std::string make_webp(std::span<const Frame> frames);
/// The same for `count` frames, which `make` returns one by one from 0; holds one at a time.
using MakeFrame = std::function<Frame(std::size_t)>;
std::string make_webp(std::size_t count, const MakeFrame& make);

/// Writes the file as base::save_whole does, with its errors.
void save_webp(const std::string& path, std::span<const Frame> frames);

}  // namespace renderer
