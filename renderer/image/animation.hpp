#pragma once
// Animated WebP files, made from a sequence of pictures.

#include <functional>
#include <span>
#include <string>

#include "renderer/image/image.hpp"

namespace renderer {

struct Frame {
  Bitmap bitmap;
  int duration_ms = 1;  ///< time that the frame is shown, 1..MAX_DURATION_MS
};

inline constexpr int MAX_DURATION_MS = (1 << 24) - 1;
/// Largest width and height of a WebP picture, in pixels.
inline constexpr int MAX_WEBP_SIDE = 16383;

/// Encodes the frames as a lossless WebP that repeats for ever. Equal consecutive frames may become
/// one frame with their total duration. The bytes depend only on the frames and on the version of
/// libwebp. They contain no date or text. Throws BadInput if there are no frames, if frames have
/// unequal sizes or are larger than MAX_WEBP_SIDE, if a duration is out of range, and if the total
/// duration exceeds 2^31 - 1 ms.
std::string make_webp(std::span<const Frame> frames);
/// Encodes `count` frames. `make` returns the frame with a number from 0 to `count` - 1. Only one
/// frame at a time is in memory.
using MakeFrame = std::function<Frame(std::size_t)>;
std::string make_webp(std::size_t count, const MakeFrame& make);

/// Writes an animation to a file with base::save_whole, whose errors it throws.
void save_webp(const std::string& path, std::span<const Frame> frames);

}  // namespace renderer
