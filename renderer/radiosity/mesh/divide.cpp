#include "renderer/radiosity/mesh/divide.hpp"

namespace radiosity {

namespace {

// Over four corners. Its points are its own: where grids touch, points are doubled.
void add_grid(Division& division, const std::array<Vec, 4>& corners, int along, int across) {
  const auto first = static_cast<std::uint32_t>(division.points.size());
  const auto row = static_cast<std::uint32_t>(along) + 1;
  for (int j = 0; j <= across; ++j)
    for (int i = 0; i <= along; ++i)
      division.points.push_back(eval_bilinear(corners, double(i) / along, double(j) / across));
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(across); ++j)
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const auto corner = first + j * row + i;
      division.quads.push_back({corner, corner + 1, corner + row + 1, corner + row});
    }
}

}  // namespace

Vec eval_bilinear(std::span<const Vec> c, double s, double t) {
  return (1 - s) * (1 - t) * c[0] + s * (1 - t) * c[1] + s * t * c[2] + (1 - s) * t * c[3];
}

Division divide_face(const Face& face, int refine) {
  Division division;
  const auto& c = face.corners;
  const int along = face.along * refine, across = face.across * refine;
  if (c.size() == 4) {
    add_grid(division, {c[0], c[1], c[2], c[3]}, along, across);
    return division;
  }
  Vec centre;
  for (const Vec& corner : c) centre += (1.0 / static_cast<double>(c.size())) * corner;
  const auto middle = [&](std::size_t i) { return 0.5 * (c[i] + c[(i + 1) % c.size()]); };
  for (std::size_t i = 0; i < c.size(); ++i)
    add_grid(division, {c[i], middle(i), centre, middle((i + c.size() - 1) % c.size())}, along,
             along);
  return division;
}

}  // namespace radiosity
