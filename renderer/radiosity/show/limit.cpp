#include "renderer/radiosity/show/limit.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

namespace {

constexpr double Rgb::*COLOURS[] = {&Rgb::r, &Rgb::g, &Rgb::b};

// How far a surface may overshoot the range of the illumination around it, as a fraction of this
// range.
constexpr double OVERSHOOT = 0.25;
// Largest ratio of the bends of an edge at its two ends (see limit_change()).
constexpr double MOST_BEND = 2;
// A change at one end of an edge that is always allowed, as a fraction of the illumination at the
// darker end. It makes the edge bulge by 4/27 of this change, 2 % of the illumination.
constexpr double FREE = 0.15;

}  // namespace

std::vector<Limits> find_limits(const Mesh& mesh, const Fans& fans, std::span<const Rgb> vertices) {
  std::vector<Limits> all;
  all.reserve(vertices.size());
  for (std::uint32_t vertex = 0; vertex < vertices.size(); ++vertex) {
    Limits range{vertices[vertex], vertices[vertex]};
    for_twins(fans.twins, vertex, [&](std::uint32_t twin) {
      for (const Wedge& wedge : fans.at(twin))
        for (const auto corner : mesh.patches[wedge.patch].corners)
          for (const auto colour : COLOURS) {
            range.least.*colour = std::min(range.least.*colour, vertices[corner].*colour);
            range.most.*colour = std::max(range.most.*colour, vertices[corner].*colour);
          }
    });
    for (const auto colour : COLOURS) {
      double &least = range.least.*colour, &most = range.most.*colour;
      const double beyond = OVERSHOOT * (most - least);
      most += beyond;
      least = std::max(least - beyond, std::min(least, least / 2));
    }
    all.push_back(range);
  }
  return all;
}

Rgb limit_change(const Limits& limits, const Rgb& value, const Rgb& change, const Rgb& whole,
                 const Rgb& there) {
  Rgb limited;
  for (const auto colour : COLOURS) {
    const double chord = whole.*colour;
    const double here = chord - change.*colour, far = there.*colour - chord;
    const double bend = here * far > 0 ? MOST_BEND * far : 0.0;
    const double free = FREE * std::max(0.0, value.*colour + std::min(0.0, chord));
    const auto [least, most] = std::minmax({-free, free, 3 * chord, chord - bend});
    const double kept = std::clamp(change.*colour, least, most);
    limited.*colour = std::clamp(kept, 3 * (limits.least.*colour - value.*colour),
                                 3 * (limits.most.*colour - value.*colour));
  }
  return limited;
}

Rgb limit_twist(const Limits& limits, const Rgb& value, const Rgb& to_next, const Rgb& to_prev,
                const Rgb& twist) {
  const Rgb flat = value + 1.0 / 3 * (to_next + to_prev), inner = flat + 1.0 / 9 * twist;
  Rgb limited = twist;
  for (const auto colour : COLOURS) {
    const double kept = std::clamp(inner.*colour, limits.least.*colour, limits.most.*colour);
    if (kept != inner.*colour) limited.*colour = 9 * (kept - flat.*colour);
  }
  return limited;
}

}  // namespace radiosity
