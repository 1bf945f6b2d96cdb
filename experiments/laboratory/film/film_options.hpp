#pragma once
// Options of tlab run --animate.
#include <string>

namespace laboratory {

struct FilmOptions {
  /// film files (.webp), or .png for frames NAME-0001.png ...; "": no film
  std::string picture, network;
  int frames = 100;

  bool is_asked() const { return !picture.empty() || !network.empty(); }
};

inline constexpr int MIN_FRAMES = 2, MAX_FRAMES = 1000;

}  // namespace laboratory
