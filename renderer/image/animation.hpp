#pragma once
// Animated WebP files from a sequence of pictures.

#include <functional>
#include <span>
#include <string>

#include "renderer/image/image.hpp"

namespace renderer {

struct Frame {
  Bitmap bitmap;
  int duration_ms = 1;  ///< duration of the frame, 1..MAX_DURATION_MS
};

inline constexpr int MAX_DURATION_MS = (1 << 24) - 1;
inline constexpr int MAX_WEBP_SIDE = 16383;  ///< largest side of a WebP picture, pixels

/// Encodes the frames as a lossless WebP that repeats for ever. Equal consecutive frames may be
/// merged into one with their total duration. The bytes depend only on the frames and on the
/// version of libwebp; they contain no date or text. Throws BadInput for no frames, frames of
/// unequal sizes or larger than MAX_WEBP_SIDE, a duration out of range, and a total duration above
/// 2^31 - 1 ms.
std::string make_webp(std::span<const Frame> frames);
/// Encodes `count` frames, which `make` returns one by one from 0. Holds one frame at a time in
/// memory.
using MakeFrame = std::function<Frame(std::size_t)>;
std::string make_webp(std::size_t count, const MakeFrame& make);

/// Writes an animation to a file as base::save_whole does, with the same errors.
void save_webp(const std::string& path, std::span<const Frame> frames);

}  // namespace renderer
