#pragma once
// Options of tlab run --animate.
#include <string>

namespace laboratory {

struct FilmOptions {
  std::string picture, network;  ///< files, .webp, or .png for NAME-0001.png ...; "": none
  int frames = 100;

  bool is_asked() const { return !picture.empty() || !network.empty(); }
};

inline constexpr int MIN_FRAMES = 2, MAX_FRAMES = 1000;

}  // namespace laboratory
