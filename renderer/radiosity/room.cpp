#include "renderer/radiosity/room.hpp"

namespace radiosity {

Vec eval_area_normal(std::span<const Vec> corners) {
  Vec normal;
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  return normal;
}

}  // namespace radiosity
