#pragma once
// Checks for faces that are divided along creases.

#include <gtest/gtest.h>

#include <map>

#include "renderer/radiosity/mesh/divide.hpp"
#include "tests/renderer/support.hpp"

namespace radiosity::test {

inline double eval_area(std::span<const Vec> corners) {
  return length(eval_area_normal(corners)) / 2;
}

// Checks everything that must be true of a division. Returns the smallest angle of its quads, in
// degrees.
inline double check_division(const Face& face, int refine, const Division& division) {
  const Vec normal = normalize(eval_area_normal(face.corners));
  double least = 180;
  double area = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& quad : division.quads) {
    std::vector<Vec> corners;
    for (const auto corner : quad) corners.push_back(division.points.at(corner));
    area += eval_area(corners);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ((sides[{quad[i], quad[(i + 1) % 4]}]++), 0) << "an edge is used twice";
      const Vec ahead = corners[(i + 1) % 4] - corners[i],
                behind = corners[(i + 3) % 4] - corners[i];
      const double sine = dot(normal, cross(ahead, behind)) / (length(ahead) * length(behind));
      EXPECT_GT(sine, 0) << "not convex, or clockwise";
      const double angle = std::atan2(sine, dot(ahead, behind) / (length(ahead) * length(behind)));
      least = std::min(least, angle * 180 / std::numbers::pi);
    }
  }
  EXPECT_NEAR(area, eval_area(face.corners), 1e-9 * area);
  // An edge that has a quad on one side only must be on the border of the face.
  double border = 0, around = 0;
  for (const auto& [edge, count] : sides)
    if (!sides.contains({edge.second, edge.first}))
      border += length(division.points[edge.first] - division.points[edge.second]);
  for (std::size_t i = 0; i < face.corners.size(); ++i)
    around += length(face.corners[(i + 1) % face.corners.size()] - face.corners[i]);
  // (If no crease crosses the face, it is divided as without creases; points may then be doubled.)
  if (division.points != divide_face(face, refine).points) {
    EXPECT_NEAR(border, around, 1e-9 * around);
  }
  for (const auto& [a, b] : division.creases)
    EXPECT_TRUE(sides.contains({a, b}) || sides.contains({b, a})) << "not an edge";
  return least;
}

}  // namespace radiosity::test
