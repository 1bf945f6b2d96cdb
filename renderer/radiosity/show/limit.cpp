#include "renderer/radiosity/show/limit.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

namespace {

constexpr double Rgb::*COLOURS[] = {&Rgb::r, &Rgb::g, &Rgb::b};

// Calls f with a vertex and each of its twins.
void for_twins(const Fans& fans, std::uint32_t vertex, const auto& f) {
  std::uint32_t v = vertex;
  do {
    f(v);
    v = fans.twins[v];
  } while (v != vertex);
}

// The share of a change, from 0 to 1, with which `value` stays within the limits.
double find_share(const Limits& limits, double Rgb::*colour, double value, double change) {
  const double room = (change > 0 ? limits.most : limits.least).*colour - value;
  return std::abs(change) > std::abs(room) ? std::max(0.0, room / change) : 1.0;
}

}  // namespace

std::vector<Limits> find_limits(const Mesh& mesh, const Fans& fans, std::span<const Rgb> vertices,
                                double overshoot) {
  std::vector<Limits> all;
  all.reserve(vertices.size());
  for (std::uint32_t vertex = 0; vertex < vertices.size(); ++vertex) {
    Limits range{vertices[vertex], vertices[vertex]};
    for_twins(fans, vertex, [&](std::uint32_t twin) {
      for (const Wedge& wedge : fans.at(twin))
        for (const auto corner : mesh.patches[wedge.patch].corners)
          for (const auto colour : COLOURS) {
            range.least.*colour = std::min(range.least.*colour, vertices[corner].*colour);
            range.most.*colour = std::max(range.most.*colour, vertices[corner].*colour);
          }
    });
    for (const auto colour : COLOURS) {
      double &least = range.least.*colour, &most = range.most.*colour;
      const double beyond = overshoot * (most - least);
      most += beyond;
      least = std::max(least - beyond, std::min(least, least / 2));
    }
    all.push_back(range);
  }
  return all;
}

void limit_slopes(const Mesh& mesh, const Fans& fans, std::span<const Rgb> vertices,
                  std::span<const Limits> limits, std::vector<Slopes<Rgb>>& slopes) {
  std::vector<Rgb> shares(vertices.size(), Rgb{1, 1, 1});
  for (std::uint32_t v = 0; v < vertices.size(); ++v)
    for (const Wedge& wedge : fans.at(v))
      for (const auto to : {wedge.next, wedge.prev}) {
        const Vec way = unfold(mesh.vertices[v], mesh.vertices[to].at);
        const Rgb change = 1.0 / 3 * along(slopes[v], way);
        for (const auto colour : COLOURS)
          shares[v].*colour =
              std::min(shares[v].*colour,
                       find_share(limits[v], colour, vertices[v].*colour, change.*colour));
      }
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    Rgb share{1, 1, 1};
    for_twins(fans, v, [&](std::uint32_t twin) {
      for (const auto colour : COLOURS)
        share.*colour = std::min(share.*colour, shares[twin].*colour);
    });
    if (share == Rgb{1, 1, 1}) continue;
    slopes[v] = {share * slopes[v].x, share * slopes[v].y, share * slopes[v].z};
  }
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
