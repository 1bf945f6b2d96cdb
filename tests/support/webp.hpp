// Reads the durations of the frames in an animated WebP file.
#pragma once

#include <string>
#include <vector>

namespace test {

inline std::size_t little_endian(const std::string& bytes, std::size_t at, int count) {
  std::size_t value = 0;
  for (int i = count - 1; i >= 0; --i)
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
  return value;
}

// Durations of the frames in milliseconds; empty for a still picture.
inline std::vector<int> durations_of_webp(const std::string& bytes) {
  std::vector<int> durations;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const auto size = little_endian(bytes, at + 4, 4);
    if (bytes.compare(at, 4, "ANMF") == 0)
      durations.push_back(static_cast<int>(little_endian(bytes, at + 8 + 12, 3)));
    at += 8 + size + size % 2;
  }
  return durations;
}

}  // namespace test
