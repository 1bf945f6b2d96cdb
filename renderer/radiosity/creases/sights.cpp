#include "renderer/radiosity/creases/sights.hpp"

#include <algorithm>

namespace radiosity {

namespace {

// The shares of the way from a to b, both beyond the apex, that a face hides from what comes
// through the apex: what is between it and the way; `behind` it, too, what lies before the apex.
void add_hidden(std::span<const Vec> face, const Vec& apex, const Vec& a, const Vec& b, bool behind,
                std::vector<Interval>& hidden) {
  const Vec u = a - apex, w = b - apex, across = cross(u, w);
  const double square = dot(across, across);
  if (!(square > 0)) return;
  const Vec normal = normalize(across);
  const auto ends = cut(face, {normal, dot(normal, apex)});
  if (!ends) return;
  // x - apex = p u + q w
  double p[2], q[2];
  for (int i = 0; i < 2; ++i) {
    const Vec x = (*ends)[i] - apex;
    p[i] = dot(cross(x, w), across) / square;
    q[i] = dot(cross(u, x), across) / square;
  }
  for (const double sign : {1.0, -1.0}) {
    if (sign < 0 && !behind) break;
    Interval inside;
    bool outside = false;
    for (const double* c : {p, q}) {
      const double here = sign * c[0], there = sign * c[1];
      outside = outside || (here < 0 && there < 0);
      if (here < 0 && there >= 0) inside.from = std::max(inside.from, here / (here - there));
      if (there < 0 && here >= 0) inside.to = std::min(inside.to, here / (here - there));
    }
    if (outside || !(inside.from < inside.to)) continue;
    const auto share = [&](double s) {
      const double beside = p[0] + s * (p[1] - p[0]), along = q[0] + s * (q[1] - q[0]);
      return std::clamp(along / (along + beside), 0.0, 1.0);
    };
    const double one = share(inside.from), other = share(inside.to);
    if (one != other) hidden.push_back({std::min(one, other), std::max(one, other)});
  }
}

}  // namespace

std::vector<Interval> find_seen(std::span<const std::vector<Vec>> faces, std::size_t except,
                                std::span<const Pencil> pencils, bool behind) {
  std::vector<Interval> hidden, seen;
  for (const auto& [apex, a, b] : pencils)
    for (std::size_t i = 0; i < faces.size(); ++i)
      if (i != except) add_hidden(faces[i], apex, a, b, behind, hidden);
  std::sort(hidden.begin(), hidden.end(),
            [](const Interval& x, const Interval& y) { return x.from < y.from; });
  double reached = 0;
  for (const Interval& part : hidden) {
    if (part.from > reached) seen.push_back({reached, part.from});
    reached = std::max(reached, part.to);
  }
  if (reached < 1) seen.push_back({reached, 1});
  return seen;
}

}  // namespace radiosity
