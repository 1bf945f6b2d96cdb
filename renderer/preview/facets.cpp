#include "renderer/preview/facets.hpp"

#include <numbers>

namespace renderer {

namespace {

constexpr double PI = std::numbers::pi;

double round_sine(double value) { return static_cast<double>(static_cast<float>(value)); }

struct Turn {
  double cosine, sine;
};

Turn make_turn(double angle) { return {round_sine(std::cos(angle)), round_sine(std::sin(angle))}; }

// An upper bound on the number of pixels that the length `size` covers in the image. The length is
// on a surface at least `distance` from the eye.
double eval_pixels(const View& view, const Params& params, double size, double distance) {
  const Raster raster = make_raster(view, params);
  // A corner of the image is the worst case. Among all points at a given distance from the eye, the
  // depth is smallest there, and a shift along the ray covers the most pixels.
  const double x = raster.step * params.width / 2, y = view.half_height;
  return size * (1 + x * x + y * y) / (raster.step * std::max(distance, 1e-9 * size));
}

// Number of facets around a circle. `radius` is in pixels.
int count_around(double radius, Fineness fineness) {
  const auto clamp = [](double count, int most) {
    return static_cast<int>(std::clamp(std::ceil(round_sine(count)), 4.0, double(most)));
  };
  if (fineness == Fineness::outline) return clamp(2 * PI * radius / 10, 24);
  // Allowed deviation in pixels. A chord of the angle 2 PI / n deviates from the circle by at most
  // radius * (1 - cos(PI / n)). A sphere has facets in two directions; each one may deviate by a
  // quarter of a pixel.
  constexpr double OFF = 0.25;
  return clamp(PI / std::acos(1 - std::min(1.0, OFF / radius)), MAX_AROUND);
}

void end_facet(Facets& facets) {
  facets.ends.push_back(static_cast<std::uint32_t>(facets.indices.size()));
}

// Adds the facets between two rings of `n` corners each. The indices of the corners begin at `a`
// and `b`. A ring that is a pole has only one corner.
void add_band(Facets& facets, std::uint32_t a, bool a_is_pole, std::uint32_t b, bool b_is_pole,
              std::uint32_t n) {
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    facets.indices.push_back(a_is_pole ? a : a + i);
    if (!a_is_pole) facets.indices.push_back(a + next);
    facets.indices.push_back(b_is_pole ? b : b + next);
    if (!b_is_pole) facets.indices.push_back(b + i);
    end_facet(facets);
  }
}

struct Divider {
  const Scene& scene;
  const Params& params;
  const Fineness fineness;
  Facets& facets;

  void operator()(const Sphere& sphere) const {
    const double distance = std::abs(length(sphere.centre - scene.view.from) - sphere.radius);
    const int around =
        count_around(eval_pixels(scene.view, params, sphere.radius, distance), fineness);
    const int bands = (around + 1) / 2;
    const auto n = static_cast<std::uint32_t>(around);
    const auto add = [&](const Vec& normal) {
      facets.corners.push_back({sphere.centre + sphere.radius * normal, normal});
    };
    add({0, 0, 1});
    for (int band = 1; band < bands; ++band) {
      const Turn up = make_turn(PI * band / bands);
      for (int i = 0; i < around; ++i) {
        const Turn turn = make_turn(2 * PI * i / around);
        add(normalize({up.sine * turn.cosine, up.sine * turn.sine, up.cosine}));
      }
    }
    add({0, 0, -1});
    std::uint32_t ring = 1;
    add_band(facets, 0, true, ring, false, n);
    for (int band = 2; band < bands; ++band, ring += n)
      add_band(facets, ring, false, ring + n, false, n);
    add_band(facets, ring, false, ring + n, true, n);
  }

  void operator()(const Polygon& polygon) const {
    add_polygon(polygon, [&](std::uint32_t) { return polygon.normal; });
  }

  void operator()(const Patch& patch) const {
    add_polygon(patch, [&](std::uint32_t i) { return scene.normals[patch.normals + i]; });
  }

  void operator()(const Cone& cone) const {
    const double apex_radius = std::max(0.0, cone.base_radius + cone.slope * cone.height);
    const double radius = std::max(cone.base_radius, apex_radius);
    const Vec way = scene.view.from - cone.base;
    const double along = std::clamp(dot(way, cone.axis), 0.0, cone.height);
    const double distance = length(way - along * cone.axis) - radius;
    const int around = count_around(eval_pixels(scene.view, params, radius, distance), fineness);
    const Vec u =
        normalize(cross(cone.axis, std::abs(cone.axis.x) < 0.5 ? Vec{1, 0, 0} : Vec{0, 1, 0}));
    const Vec v = cross(cone.axis, u);
    const auto add_ring = [&](const Vec& centre, double ring_radius) {
      for (int i = 0; i < around; ++i) {
        const Turn turn = make_turn(2 * PI * i / around);
        const Vec out = turn.cosine * u + turn.sine * v;
        facets.corners.push_back(
            {centre + ring_radius * out, normalize(out - cone.slope * cone.axis)});
      }
    };
    add_ring(cone.base, cone.base_radius);
    add_ring(cone.base + cone.height * cone.axis, apex_radius);
    const auto n = static_cast<std::uint32_t>(around);
    add_band(facets, 0, false, n, false, n);
  }

 private:
  template <class Normal>
  void add_polygon(const Polygon& polygon, const Normal& normal) const {
    for (std::uint32_t i = 0; i < polygon.count; ++i) {
      facets.corners.push_back({eval_corner(polygon, scene.corners[polygon.first + i]), normal(i)});
      facets.indices.push_back(i);
    }
    end_facet(facets);
  }
};

}  // namespace

void make_facets(const Scene& scene, Place place, const Params& params, Fineness fineness,
                 Facets& facets) {
  facets.corners.clear();
  facets.indices.clear();
  facets.ends.clear();
  visit(scene, place, Divider{scene, params, fineness, facets});
}

}  // namespace renderer
