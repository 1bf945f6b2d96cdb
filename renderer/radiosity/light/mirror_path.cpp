#include "renderer/radiosity/light/mirror_path.hpp"

#include <algorithm>

namespace radiosity {

Vec mirror_direction(const Mirror& mirror, const Vec& direction) {
  return direction - 2 * dot(mirror.normal, direction) * mirror.normal;
}

Vec mirror_point(const Mirror& mirror, const Vec& point) {
  return mirror.corners[0] + mirror_direction(mirror, point - mirror.corners[0]);
}

bool is_within(const Mirror& mirror, const Vec& point, double margin) {
  const auto& c = mirror.corners;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Vec edge = c[(i + 1) % c.size()] - c[i];
    const double inside = dot(mirror.normal, cross(edge, point - c[i]));
    if (inside < 0 && (margin == 0 || inside < -margin * length(edge))) return false;
  }
  return true;
}

bool Chain::can_meet(const Mirror& mirror) const {
  return dot(mirror.normal, last().at - mirror.corners[0]) > 0 &&
         (mirrors.empty() || (mirrors.back() != &mirror && may_show(mirror.corners)));
}

bool Chain::may_show(std::span<const Vec> corners) const {
  const Mirror& window = *mirrors.back();
  const auto is_out = [&](const Vec& normal, const Vec& through) {
    return std::ranges::all_of(corners,
                               [&](const Vec& c) { return dot(normal, c - through) <= 0; });
  };
  if (is_out(window.normal, window.centre)) return false;
  const Vec& eye = last().at;  // behind the window
  const auto& edge = window.corners;
  for (std::size_t i = 0; i < edge.size(); ++i)
    if (is_out(cross(edge[i] - eye, edge[(i + 1) % edge.size()] - eye), eye)) return false;
  return true;
}

Chain Chain::extend(const Mirror& mirror, const Rgb& by) const {
  Chain longer = *this;
  const Vec way = mirror.centre - last().at;
  const double square = dot(way, way);
  longer.width = std::min(width, mirror.width * -dot(mirror.normal, way) / square);
  longer.images.push_back(
      {mirror_point(mirror, last().at), mirror_direction(mirror, last().normal)});
  longer.mirrors.push_back(&mirror);
  longer.reflectance = reflectance * by;
  return longer;
}

std::optional<Path> find_path(const Chain& chain, const Vec& to) {
  Path points;
  Vec from = to;
  for (std::size_t j = chain.mirrors.size(); j-- > 0;) {
    const Mirror& mirror = *chain.mirrors[j];
    const Vec way = chain.images[j + 1].at - from;
    const double before = dot(mirror.normal, from - mirror.corners[0]);
    const double along = dot(mirror.normal, way);
    if (!(before > 0 && along < 0)) return std::nullopt;  // behind the mirror, or away from it
    points[j] = from + before / -along * way;
    if (!is_within(mirror, points[j])) return std::nullopt;
    from = points[j];
  }
  return points;
}

// The ways form a cone whose tip is the vertex's image; a mirror cuts it in an ellipse.
bool misses(const Chain& chain, const Vec& to, double radius) {
  Vec from = to;
  const double whole = length(to - chain.last().at);
  double gone = 0;
  for (std::size_t j = chain.mirrors.size(); j-- > 0;) {
    const Mirror& mirror = *chain.mirrors[j];
    const Vec way = chain.images[j + 1].at - from;
    const double before = dot(mirror.normal, from - mirror.corners[0]);
    const double along = -dot(mirror.normal, way), left = length(way);
    if (!(before > radius && along > radius)) return false;  // no telling
    const Vec point = from + before / along * way;
    gone += before / along * left;
    const double slope = (along - radius) / left;  // the least cosine of the cone's lines, about
    if (!is_within(mirror, point, 2 * radius * (whole - gone) / whole / slope)) return true;
    from = point;
  }
  return false;
}

bool is_free(const Eye& eye, const Vertex& vertex, const Chain& chain, const Path& path,
             const Vec& to, std::uint32_t object, renderer::Work& work) {
  Vec from = vertex.lit;
  std::uint32_t on = vertex.object;
  for (std::size_t j = 0; j < chain.mirrors.size(); ++j) {
    const std::uint32_t mirror = chain.mirrors[j]->object;
    if (!sees(eye, from, on, path[j], mirror, work)) return false;
    from = path[j];
    on = mirror;
  }
  return sees(eye, from, on, to, object, work);
}

}  // namespace radiosity
