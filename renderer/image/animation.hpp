#pragma once
// Pictures one after the other, as an animated WebP file.

#include <functional>
#include <span>
#include <string>

#include "renderer/image/image.hpp"

namespace renderer {

struct Frame {
  Bitmap bitmap;
  int duration_ms = 1;  ///< time that it is shown, 1..MAX_DURATION_MS
};

inline constexpr int MAX_DURATION_MS = (1 << 24) - 1;
inline constexpr int MAX_WEBP_SIDE = 16383;  ///< pixels

/// The bytes of a WebP file that repeats for ever, lossless: what a reader shows at any time are
/// the frames' bytes. Equal frames in a row may become one, shown as long. The bytes depend on the
/// frames and on libwebp's version only: no date, no text, no threads. BadInput for no frame,
/// frames of unequal or too large sizes, a duration out of range,
/// and more than 2^31 - 1 ms together.
std::string make_webp(std::span<const Frame> frames);
/// The same of `count` frames that are made one after another, from 0; no two are held at once.
using MakeFrame = std::function<Frame(std::size_t)>;
std::string make_webp(std::size_t count, const MakeFrame& make);

/// Writes them as base::save_whole does, with its errors.
void save_webp(const std::string& path, std::span<const Frame> frames);

}  // namespace renderer
