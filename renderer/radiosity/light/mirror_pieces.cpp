#include "renderer/radiosity/light/mirror_pieces.hpp"

#include <algorithm>
#include <limits>

namespace radiosity {

using renderer::Op;
using renderer::Work;

namespace {

// The rectangle around a mirror along its first edge, n x n pieces.
struct Pieces {
  Pieces(const Mirror& mirror, int n) : n(n) {
    const Vec along = normalize(mirror.corners[1] - mirror.corners[0]);
    const Vec across = cross(mirror.normal, along);
    double lo_u = 0, hi_u = 0, lo_v = 0, hi_v = 0;
    for (const Vec& corner : mirror.corners) {
      const Vec d = corner - mirror.corners[0];
      lo_u = std::min(lo_u, dot(d, along));
      hi_u = std::max(hi_u, dot(d, along));
      lo_v = std::min(lo_v, dot(d, across));
      hi_v = std::max(hi_v, dot(d, across));
    }
    origin = mirror.corners[0] + lo_u * along + lo_v * across;
    u = (hi_u - lo_u) / n * along;
    v = (hi_v - lo_v) / n * across;
  }
  Vec centre(int i, int j) const { return origin + (i + 0.5) * u + (j + 0.5) * v; }
  double area() const { return length(u) * length(v); }
  int n;
  Vec origin, u, v;  // u and v: the sides of a piece
};

// The least of the solid angles of the pieces that a path meets, and whose it is.
struct Least {
  double angle = std::numeric_limits<double>::infinity();
  std::size_t mirror = 0;
};

// A way from the vertex over a chain to the patch's plane.
struct Way {
  Path path;
  Vec end;
  Least least;
};

class PieceSum {
 public:
  PieceSum(const MirroredPatch& seen, Work& work) : seen_(seen), work_(work) {
    for (const Mirror* mirror : seen.chain.mirrors)
      pieces_.emplace_back(*mirror, seen.eye.params.mirror_pieces);
  }

  double sum() {
    const int n = seen_.eye.params.samples;
    double total = 0;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) total += add_delta((i + 0.5) / n, (j + 0.5) / n, 0.5 / n);
    return total;
  }

 private:
  // The delta area within `half` of (s, t).
  double add_delta(double s, double t, double half) {
    work_[Op::delta_area] += 1;
    const Quad& quad = seen_.quad;
    const double area = 4 * half * half * quad.eval_density(s, t);
    const Vec centre = quad.eval(s, t);
    if (const auto path = find_path(seen_.chain, centre)) {
      const Way way{*path, centre, least_angle(*path)};
      if (way.least.angle >= solid_angle(area, centre)) return add_way(way, area, 1);
    }
    corners_ = {quad.eval(s - half, t - half), quad.eval(s + half, t - half),
                quad.eval(s + half, t + half), quad.eval(s - half, t + half)};
    double total = 0;
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      for (int j = 0; j < pieces_[k].n; ++j)
        for (int i = 0; i < pieces_[k].n; ++i) {
          work_[Op::light_mirrored] += 1;
          // A way is found over the pieces of each of its mirrors: where these are the least.
          const auto way = follow(k, pieces_[k].centre(i, j));
          if (!way || way->least.mirror != k) continue;
          const double whole = solid_angle(area, way->end);
          if (way->least.angle < whole) total += add_way(*way, area, way->least.angle / whole);
        }
    return total;
  }

  // Eq 3.17's term for a share h of the delta area.
  double add_way(const Way& way, double area, double h) {
    const Viewpoint& eye = seen_.chain.last();
    const Vec line = way.end - eye.at;
    const double here = dot(eye.normal, line), there = -dot(seen_.quad.normal, line);
    if (here <= 0 || there <= 0 ||
        !is_free(seen_.eye, seen_.vertex, seen_.chain, way.path, way.end, seen_.patch.object,
                 work_))
      return 0;
    return eval_delta(h * area, dot(line, line), here, there);
  }

  // From the vertex over the chain, at its k-th mirror through a piece's centre, if it ends in the
  // delta area.
  std::optional<Way> follow(std::size_t k, const Vec& centre) const {
    const auto& chain = seen_.chain;
    if (!is_within(*chain.mirrors[k], centre)) return std::nullopt;
    // Straight on from the vertex's last image.
    Vec through = centre;
    for (std::size_t j = k + 1; j < chain.mirrors.size(); ++j)
      through = mirror_point(*chain.mirrors[j], through);
    const Vec direction = through - chain.last().at;
    const double along = dot(seen_.quad.normal, direction);
    if (!(along < 0)) return std::nullopt;
    const Vec end = chain.last().at +
                    dot(seen_.quad.normal, seen_.quad.p - chain.last().at) / along * direction;
    if (!is_in_delta(end)) return std::nullopt;
    const auto path = find_path(chain, end);
    if (!path) return std::nullopt;
    return Way{*path, end, least_angle(*path)};
  }

  bool is_in_delta(const Vec& point) const {
    for (std::size_t k = 0; k < 4; ++k)
      if (dot(seen_.quad.normal, cross(corners_[(k + 1) % 4] - corners_[k], point - corners_[k])) <
          0)
        return false;
    return true;
  }

  // Seen from the vertex over the chain.
  double solid_angle(double area, const Vec& point) const {
    const Vec line = point - seen_.chain.last().at;
    const double square = dot(line, line);
    return area * -dot(seen_.quad.normal, line) / (square * std::sqrt(square));
  }

  // Eq 3.18's minimum over the pieces that a path meets.
  Least least_angle(const Path& path) const {
    Least least;
    double distance = 0;
    Vec from = seen_.vertex.lit;
    for (std::size_t j = 0; j < pieces_.size(); ++j) {
      const Vec line = path[j] - from;
      const double step = length(line);
      distance += step;
      const double cosine = -dot(seen_.chain.mirrors[j]->normal, line) / step;
      const double angle = pieces_[j].area() * cosine / (distance * distance);
      if (angle < least.angle) least = {angle, j};
      from = path[j];
    }
    return least;
  }

  const MirroredPatch& seen_;
  std::vector<Pieces> pieces_;  // of each mirror of the chain
  std::array<Vec, 4> corners_;  // of the delta area
  Work& work_;
};

}  // namespace

double sum_pieces(const MirroredPatch& seen, Work& work) { return PieceSum(seen, work).sum(); }

}  // namespace radiosity
