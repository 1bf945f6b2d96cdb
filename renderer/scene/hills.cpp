#include "renderer/scene/hills.hpp"

#include <array>

#include "base/random.hpp"
#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

// Seeds of the random numbers, one for each purpose. The octaves of eval_ridges() use the seeds
// from 0 upwards.
enum Seed { ROLLING = 100, ROUGHNESS, MASSIFS, BORDERS, FORESTS, ORDER };

// A random number from -1 to 1. It depends only on `which` and on a point of the integer lattice.
double random_at_point(std::uint64_t which, double x, double y) {
  const auto key = (static_cast<std::uint64_t>(static_cast<std::int64_t>(x)) << 32) ^
                   static_cast<std::uint32_t>(static_cast<std::int64_t>(y));
  return static_cast<double>(base::random_at(which, key) >> 11) * 0x1p-52 - 1;
}

// K. Perlin's gradient noise (1985, 2002). Its values are about -0.7..0.7, and 0 at lattice points.
double eval_noise(std::uint64_t seed, double x, double y) {
  const double left = std::floor(x), front = std::floor(y), u = x - left, v = y - front;
  const auto slope = [&](double i, double j) {
    return random_at_point(2 * seed, left + i, front + j) * (u - i) +
           random_at_point(2 * seed + 1, left + i, front + j) * (v - j);
  };
  const auto blend = [](double t, double a, double b) {
    return a + t * t * t * (t * (6 * t - 15) + 10) * (b - a);
  };
  return blend(v, blend(u, slope(0, 0), slope(1, 0)), blend(u, slope(0, 1), slope(1, 1)));
}

// F. Musgrave's ridged multifractal, from 0 to about 1. Heights are rugged, and valleys are smooth.
double eval_ridges(double x, double y) {
  constexpr int OCTAVES = 8;
  double sum = 0, share = 0.5, weight = 1;
  for (int octave = 0; octave < OCTAVES; ++octave, share /= 2) {
    const double ridge = 1 - std::min(1.0, 1.5 * std::abs(eval_noise(octave, x, y)));
    weight = std::min(1.0, ridge * ridge * weight * 1.6);
    sum += share * weight;
    // rotated and shifted, so that no two octaves have a common lattice
    const double turned = 2 * (0.8 * x - 0.6 * y) + 0.37;
    y = 2 * (0.6 * x + 0.8 * y) + 0.59;
    x = turned;
  }
  return sum;
}

// A smooth step: 0 up to `from`, 1 from `to` on.
double eval_step(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Height of the ground above the surface of the lake, which is at 0. Distant ground rises to
// mountains of different heights.
double eval_ground(double x, double y) {
  const double hills = 1.8 * (eval_ridges(x / 8 + 1.6, y / 8) - 0.4);
  const double rolling =
      0.35 * eval_noise(ROLLING, x / 2.5, y / 2.5) + 0.1 * eval_noise(ROUGHNESS, x, y);
  const double ridges = eval_ridges(x / 14 + 2.3, y / 14 + 2.3);
  const double mountains = 7.5 * ridges * ridges * eval_step(9, 36, y) *
                           (1 + 0.9 * eval_noise(MASSIFS, x / 10 + 2.3, y / 10 + 2.3));
  const double to_lake_x = (x - 0.7) / 5, to_lake_y = (y - 7) / 5;
  const double lake =
      1.9 * (1 - eval_step(0.2, 1.2, to_lake_x * to_lake_x + to_lake_y * to_lake_y));
  return 0.7 + hills + rolling + mountains - lake;
}

// Indices of the points of a triangle, counter-clockwise as seen from above.
using Corners = std::array<std::uint32_t, 3>;

// Strips of triangles between rows of points. The first row is in front, the last row at the back.
struct Ground {
  std::vector<Vec> points;
  std::vector<Corners> triangles;
};

// Adds a row of points. `way` is 0 for the front row and 1 for the back row. Distance and width of
// rows grow with the fourth power of a function of `way` that approximates an exponential.
void add_row(Ground& ground, double way, int segments) {
  constexpr double REACH = 0.42;
  const double q = (1 + REACH * way) / (1 - REACH * way), distance = 1.2 * q * q * q * q;
  const double half_width = 0.6 * distance;
  for (int i = 0; i <= segments; ++i) {
    const double x = (2.0 * i / segments - 1) * half_width, y = distance - 1.4;
    ground.points.push_back({x, y, std::max(0.0, eval_ground(x, y))});
  }
}

// Adds the triangles between two rows of points: from index `front` to `back` - 1, and from `back`
// to `end` - 1.
void add_strip(Ground& ground, std::uint32_t front, std::uint32_t back, std::uint32_t end) {
  const auto& p = ground.points;
  for (std::uint32_t a = front, b = back; a + 1 < back || b + 1 < end;) {
    const bool goes_in_front =
        b + 1 == end || (a + 1 < back && length(p[a + 1] - p[b]) <= length(p[b + 1] - p[a]));
    ground.triangles.push_back({a, goes_in_front ? a + 1 : b + 1, b});
    ++(goes_in_front ? a : b);
  }
}

// Makes `n` triangles in strips. A strip has a triangle for each segment of its two rows. All rows
// get the same number of segments; then some rows get one more segment, so that there are `n`
// triangles. An extra segment adds two triangles if its row is an inner one, and one triangle if it
// is the last row.
Ground make_ground(int n) {
  const int strips = static_cast<int>(std::sqrt(0.8 * n)), segments = n / (2 * strips);
  const int wanting = n % (2 * strips);
  Ground ground;
  std::uint32_t front = 0;
  for (int row = 0; row <= strips; ++row) {
    const auto back = static_cast<std::uint32_t>(ground.points.size());
    const bool has_more = row == strips ? wanting % 2 == 1 : row > 0 && row <= wanting / 2;
    add_row(ground, static_cast<double>(row) / strips, segments + has_more);
    if (row > 0) add_strip(ground, front, back, static_cast<std::uint32_t>(ground.points.size()));
    front = back;
  }
  return ground;
}

// Shuffles the triangles. In the order of rows, the boxes of the hierarchy would be as long as
// rows, which would double the number of tests.
void shuffle(std::vector<Corners>& triangles) {
  for (std::size_t i = triangles.size(); i > 1; --i)
    std::swap(triangles[i - 1], triangles[base::random_at(ORDER, i) % i]);
}

// Makes a unit normal for each point: the mean of the normals of the triangles around it, weighted
// by area.
std::vector<Vec> make_normals(const Ground& ground) {
  const auto& p = ground.points;
  std::vector<Vec> normals(p.size());
  for (const auto& [a, b, c] : ground.triangles)
    for (const auto i : {a, b, c}) normals[i] += cross(p[b] - p[a], p[c] - p[a]);
  for (Vec& normal : normals) normal = normalize(normal);
  return normals;
}

enum Cover { WATER, SAND, MEADOW, FOREST, ROCK, SNOW };
constexpr Surface COVERS[] = {{.colour = {0.10, 0.22, 0.30}, .kd = 0.45, .ks = 0.55, .shine = 200},
                              {.colour = {0.76, 0.68, 0.48}, .kd = 0.8},
                              {.colour = {0.48, 0.62, 0.22}, .kd = 0.8},
                              {.colour = {0.20, 0.40, 0.15}, .kd = 0.8},
                              {.colour = {0.56, 0.50, 0.45}, .kd = 0.8},
                              {.colour = {0.95, 0.96, 1.00}, .kd = 0.9}};

// Chooses the ground cover of a triangle by its height and slope. Noise frays the borders between
// covers.
Cover choose_cover(const Ground& ground, const std::vector<Vec>& normals, const Corners& corners) {
  Vec centre, normal;
  for (const auto i : corners) {
    centre += (1 / 3.0) * ground.points[i];
    normal += (1 / 3.0) * normals[i];
  }
  if (centre.z == 0) return WATER;
  if (centre.z < 0.05) return SAND;
  const double z = centre.z + 0.6 * eval_noise(BORDERS, 1.5 * centre.x, 1.5 * centre.y);
  if (z > 3 && normal.z > 0.6) return SNOW;
  if (z > 1.9 || normal.z < 0.6) return ROCK;
  const double trees = eval_noise(FORESTS, 0.6 * centre.x, 0.6 * centre.y);
  return trees + 0.2 * (z - 0.5) > 0 ? FOREST : MEADOW;
}

}  // namespace

Scene make_hills(int n) {
  require(n >= 2 && n <= MAX_HILLS, fmt::format("hills:{}", n),
          fmt::format("hills:N with N from 2 to {}", MAX_HILLS));
  Scene scene;
  scene.view = {.from = {0, 0, 2.2}, .at = {0, 10, 1.3}, .up = {0, 0, 1}, .angle = 45};
  scene.background = {0.45, 0.65, 0.92};
  scene.lights = {{{-800, 100, 500}, {1.0, 0.92, 0.8}}, {{500, -600, 700}, {0.4, 0.45, 0.55}}};

  Ground ground = make_ground(n);
  shuffle(ground.triangles);
  const std::vector<Vec> normals = make_normals(ground);
  std::array<std::vector<Corners>, std::size(COVERS)> covered;
  for (const Corners& corners : ground.triangles)
    covered[choose_cover(ground, normals, corners)].push_back(corners);
  for (std::size_t cover = 0; cover < covered.size(); ++cover) {
    scene.surfaces.push_back(COVERS[cover]);
    for (const auto& [a, b, c] : covered[cover]) {
      const std::array at = {ground.points[a], ground.points[b], ground.points[c]};
      const std::array bent = {normals[a], normals[b], normals[c]};
      // A thin triangle between steep neighbours may face away from the normals at its corners.
      const Vec flat = cross(at[1] - at[0], at[2] - at[0]);
      const bool is_front =
          std::ranges::all_of(bent, [&](const Vec& normal) { return dot(normal, flat) > 0; });
      if (cover == WATER || !is_front)
        add_polygon(scene, at);
      else
        add_patch(scene, at, bent);
    }
  }
  finish(scene);
  return scene;
}

}  // namespace renderer
