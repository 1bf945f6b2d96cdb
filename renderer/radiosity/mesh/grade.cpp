#include "renderer/radiosity/mesh/grade.hpp"

#include <algorithm>
#include <cmath>

#include "renderer/radiosity/mesh/divide.hpp"

namespace radiosity {

namespace {

// The longest side of a patch near a light, in distances from it.
constexpr double LONGEST = 0.5;
// Times that a row is halved: a light may touch a face.
constexpr int MOST_HALVINGS = 3;

struct Light {
  std::span<const Vec> corners;
  bool two_sided;
  Plane plane;
  std::vector<Plane> edges;  // their insides are above
};

std::vector<Light> find_lights(const Room& room) {
  std::vector<Light> lights;
  for (const Face& face : room.faces) {
    const Material& material = room.materials[face.material];
    if (material.mirror || !(max_component(material.emission) > 0)) continue;
    const Vec normal = normalize(eval_area_normal(face.corners));
    lights.push_back({face.corners, face.two_sided, make_plane(normal, eval_mean(face.corners)),
                      make_edge_planes(face.corners, normal)});
  }
  return lights;
}

// How far a point is from a light.
double find_distance(const Light& light, const Vec& point) {
  if (std::ranges::all_of(light.edges,
                          [&](const Plane& edge) { return eval_height(edge, point) >= 0; }))
    return std::abs(eval_height(light.plane, point));
  double least = INFINITY;
  for (std::size_t i = 0; i < light.corners.size(); ++i)
    least = std::min(least, eval_distance(point, light.corners[i],
                                          light.corners[(i + 1) % light.corners.size()]));
  return least;
}

// Whether some of the light is before the face, and the point before the light.
bool is_lit(const Light& light, const Face& face, const Plane& plane, const Vec& point) {
  const auto is_before = [](double height, bool two_sided) {
    return two_sided ? height != 0 : height > 0;
  };
  return is_before(eval_height(light.plane, point), light.two_sided) &&
         std::ranges::any_of(light.corners, [&](const Vec& corner) {
           return is_before(eval_height(plane, corner), face.two_sided);
         });
}

// Halves the rows in which a patch is too long, once; whether there are any.
bool halve_once(const Face& face, const std::vector<Light>& lights, Grid& grid) {
  const Plane plane =
      make_plane(normalize(eval_area_normal(face.corners)), eval_mean(face.corners));
  auto& [along, across] = grid;
  std::vector<bool> wide(along.size()), high(across.size());
  for (std::size_t j = 0; j + 1 < across.size(); ++j)
    for (std::size_t i = 0; i + 1 < along.size(); ++i) {
      const auto at = [&](double s, double t) { return eval_bilinear(face.corners, s, t); };
      const double s = (along[i] + along[i + 1]) / 2, t = (across[j] + across[j + 1]) / 2;
      const double width = length(at(along[i + 1], t) - at(along[i], t));
      const double height = length(at(s, across[j + 1]) - at(s, across[j]));
      for (const Light& light : lights) {
        if (!is_lit(light, face, plane, at(s, t))) continue;
        const double longest = LONGEST * find_distance(light, at(s, t));
        if (width > longest) wide[i] = true;
        if (height > longest) high[j] = true;
      }
    }
  const auto lines = along.size() + across.size();
  halve(along, wide);
  halve(across, high);
  return along.size() + across.size() > lines;
}

}  // namespace

void grade_near_lights(Room& room, int refine) {
  if (!room.fine_near_lights) return;
  room.fine_near_lights = false;
  const auto lights = find_lights(room);
  for (Face& face : room.faces) {
    const Material& material = room.materials[face.material];
    if (face.corners.size() != 4 || material.mirror || !(max_component(material.reflectance) > 0))
      continue;
    Grid grid = find_grid(face, refine);
    for (int i = 0; i < MOST_HALVINGS; ++i) {
      if (!halve_once(face, lights, grid)) break;
      face.grid = grid;
    }
  }
}

}  // namespace radiosity
