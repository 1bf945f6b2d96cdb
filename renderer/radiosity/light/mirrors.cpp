#include "renderer/radiosity/light/mirrors.hpp"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <optional>

namespace radiosity {

using renderer::Op;
using renderer::Work;

namespace {

// A chain of mirrors along a path of light, unfolded into a straight line. The viewpoint is
// reflected in the mirrors, instead of the surface that it sees (figures 3.11 and 3.12).
// `images[0]` is the viewpoint at the vertex; `images[j]` is its image in the first j mirrors of
// the chain.
struct Chain {
  template <class T, std::size_t most>
  using List = boost::container::static_vector<T, most>;

  List<const Mirror*, MOST_REFLECTIONS> mirrors;  // in the order from the vertex outwards
  List<Viewpoint, MOST_REFLECTIONS + 1> images;
  Rgb reflectance{1, 1, 1};  // product of the mirrors' reflectances
  // Approximate visual angle of the narrowest mirror, in radians.
  double width = std::numeric_limits<double>::infinity();

  explicit Chain(const Viewpoint& eye) : images{eye} {}
  const Viewpoint& last() const { return images.back(); }
  // True if light from the mirror can reach the last mirror of the chain, or the vertex if the
  // chain is empty.
  bool can_meet(const Mirror& mirror) const;
  // True if part of a convex polygon may be visible in the last mirror: no plane through the image
  // of the viewpoint and an edge of the mirror separates mirror and polygon.
  bool may_show(std::span<const Vec> corners) const;
  // Returns this chain extended by a mirror with the reflectance `by`.
  Chain extend(const Mirror& mirror, const Rgb& by) const;
};

// The points where a path of light meets the mirrors of a chain, in the chain's order.
using Path = std::array<Vec, MOST_REFLECTIONS>;

Vec mirror_direction(const Mirror& mirror, const Vec& direction) {
  return direction - 2 * dot(mirror.normal, direction) * mirror.normal;
}

Vec mirror_point(const Mirror& mirror, const Vec& point) {
  return mirror.corners[0] + mirror_direction(mirror, point - mirror.corners[0]);
}

// True if `point`, in the plane of the convex polygon `c`, is inside the polygon or at most
// `margin` outside.
bool is_within(std::span<const Vec> c, const Vec& normal, const Vec& point, double margin = 0) {
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Vec edge = c[(i + 1) % c.size()] - c[i];
    const double inside = dot(normal, cross(edge, point - c[i]));
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
  const Vec& eye = last().at;  // image of the viewpoint, behind the last mirror
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

// The path from the vertex via the chain to a point; none if it would pass beside a mirror.
std::optional<Path> find_path(const Chain& chain, const Vec& to) {
  Path points;
  Vec from = to;
  for (std::size_t j = chain.mirrors.size(); j-- > 0;) {
    const Mirror& mirror = *chain.mirrors[j];
    const Vec way = chain.images[j + 1].at - from;
    const double before = dot(mirror.normal, from - mirror.corners[0]);
    const double along = dot(mirror.normal, way);
    // the point is behind the mirror, or the path leads away from the mirror
    if (!(before > 0 && along < 0)) return std::nullopt;
    points[j] = from + before / -along * way;
    if (!is_within(mirror.corners, mirror.normal, points[j])) return std::nullopt;
    from = points[j];
  }
  return points;
}

// True only if all paths to points within `radius` of `to` pass beside a mirror. The paths form a
// cone with its apex at the image of the vertex. A mirror's plane cuts the cone in an ellipse.
bool surely_misses(const Chain& chain, const Vec& to, double radius) {
  Vec from = to;
  const double whole = length(to - chain.last().at);
  double gone = 0;
  for (std::size_t j = chain.mirrors.size(); j-- > 0;) {
    const Mirror& mirror = *chain.mirrors[j];
    const Vec way = chain.images[j + 1].at - from;
    const double before = dot(mirror.normal, from - mirror.corners[0]);
    const double along = -dot(mirror.normal, way), left = length(way);
    // part of the cone may lie beside the mirror, so that this test cannot decide
    if (!(before > radius && along > radius)) return false;
    const Vec point = from + before / along * way;
    gone += before / along * left;
    // approximate lower bound on the cosines between the mirror's normal and the lines of the cone
    const double slope = (along - radius) / left;
    const double margin = 2 * radius * (whole - gone) / whole / slope;
    if (!is_within(mirror.corners, mirror.normal, point, margin)) return true;
    from = point;
  }
  return false;
}

// The `sight` of sum_deltas() for light from a patch that reaches a vertex via a chain of mirrors.
struct MirroredSight {
  const Eye& eye;
  const Vertex& vertex;
  const Patch& patch;
  const Quad& quad;  // geometry of `patch`
  const Chain& chain;
  Work& work;

  // True if nothing blocks the path from the vertex, over the points `path` on the mirrors, to
  // `to`.
  bool is_free(const Path& path, const Vec& to) const {
    Vec from = vertex.lit;
    std::uint32_t on = vertex.object;
    for (std::size_t j = 0; j < chain.mirrors.size(); ++j) {
      const std::uint32_t mirror = chain.mirrors[j]->object;
      if (!radiosity::sees(eye, from, on, path[j], mirror, work)) return false;
      from = path[j];
      on = mirror;
    }
    return radiosity::sees(eye, from, on, to, patch.object, work);
  }
  bool sees(const Vec& point) const {
    work[Op::light_mirrored] += chain.mirrors.size();
    const auto path = find_path(chain, point);
    return path && is_free(*path, point);
  }
  bool misses(const Vec& point, double radius) const {
    work[Op::light_mirrored] += chain.mirrors.size();
    return surely_misses(chain, point, radius);
  }
};

// The bounding rectangle of a mirror, parallel to its first edge and divided into n x n pieces.
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
  Vec origin, u, v;  // `origin` is a corner of the rectangle; u and v are the sides of a piece
};

// The smallest solid angle of all pieces on a path, and the mirror of the piece with this angle.
// The mirror is an index into the chain of mirrors.
struct Least {
  double angle = std::numeric_limits<double>::infinity();
  std::size_t mirror = 0;
};

// A path from the vertex via all mirrors of a chain to the plane of the patch.
struct Way {
  Path path;
  Vec end;
  Least least;
};

// The sum of thesis Eq 3.17 over the delta areas of the patch and the pieces of the chain's
// mirrors. There are samples x samples delta areas, which are not halved, and
// FactorParams::mirror_pieces pieces along and across each mirror.
template <class Source>
class PieceSum {
 public:
  using Sum = SumOf<Source>;

  PieceSum(const MirroredSight& seen, const Source& source) : seen_(seen), source_(source) {
    for (const Mirror* mirror : seen.chain.mirrors)
      pieces_.emplace_back(*mirror, seen.eye.params.mirror_pieces);
  }

  Sum sum() {
    const int n = seen_.eye.params.samples;
    Sum total{};
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const double s = (i + 0.5) / n, t = (j + 0.5) / n;
        total += add_delta(s, t, 0.5 / n) * source_.eval(s, t);
      }
    return total;
  }

 private:
  // The form factor of the delta area that extends by `half` around (s, t).
  double add_delta(double s, double t, double half) {
    seen_.work[Op::delta_area] += 1;
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
          seen_.work[Op::light_mirrored] += 1;
          // Each mirror of a path leads to this path through one of its pieces. The path counts
          // only for the mirror whose piece has the smallest solid angle.
          const auto way = follow(k, pieces_[k].centre(i, j));
          if (!way || way->least.mirror != k) continue;
          const double whole = solid_angle(area, way->end);
          if (way->least.angle < whole) total += add_way(*way, area, way->least.angle / whole);
        }
    return total;
  }

  // The term of Eq 3.17 for the fraction `h` of the delta area.
  double add_way(const Way& way, double area, double h) {
    const Viewpoint& eye = seen_.chain.last();
    const Vec line = way.end - eye.at;
    const double here = dot(eye.normal, line), there = -dot(seen_.quad.normal, line);
    if (here <= 0 || there <= 0 || !seen_.is_free(way.path, way.end)) return 0;
    return eval_delta(h * area, dot(line, line), here, there);
  }

  // Returns the path from the vertex via the chain of mirrors that passes through `centre`, the
  // centre of a piece of mirror number k. Returns none if the path ends outside the delta area.
  std::optional<Way> follow(std::size_t k, const Vec& centre) const {
    const auto& chain = seen_.chain;
    if (!is_within(chain.mirrors[k]->corners, chain.mirrors[k]->normal, centre))
      return std::nullopt;
    // The unfolded path is a straight line that begins at the last image of the vertex.
    Vec through = centre;
    for (std::size_t j = k + 1; j < chain.mirrors.size(); ++j)
      through = mirror_point(*chain.mirrors[j], through);
    const Vec direction = through - chain.last().at;
    const double along = dot(seen_.quad.normal, direction);
    if (!(along < 0)) return std::nullopt;
    const Vec end = chain.last().at +
                    dot(seen_.quad.normal, seen_.quad.p - chain.last().at) / along * direction;
    if (!is_within(corners_, seen_.quad.normal, end)) return std::nullopt;
    const auto path = find_path(chain, end);
    if (!path) return std::nullopt;
    return Way{*path, end, least_angle(*path)};
  }

  // The solid angle of an area at `point` as seen from the vertex via the chain.
  double solid_angle(double area, const Vec& point) const {
    const Vec line = point - seen_.chain.last().at;
    const double square = dot(line, line);
    return area * -dot(seen_.quad.normal, line) / (square * std::sqrt(square));
  }

  // The smallest solid angle (thesis Eq 3.18) of the pieces on a path.
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

  const MirroredSight& seen_;
  const Source& source_;
  std::vector<Pieces> pieces_;  // pieces of each mirror of the chain
  std::array<Vec, 4> corners_;  // corners of the current delta area
};

// The light that arrives via one chain, before multiplication by the mirrors' reflectances.
template <class Source>
auto eval_chain(const MirroredSight& sight, const Source& source) {
  const FactorParams& params = sight.eye.params;
  if (params.mirror_pieces > 0) return PieceSum(sight, source).sum();
  // Lower limit on the angle of delta areas, as a fraction of params.spread. A narrower mirror
  // reflects too little light to justify smaller delta areas.
  constexpr double LEAST = 0.25;
  const double spread =
      std::clamp(params.mirror_share * sight.chain.width, LEAST * params.spread, params.spread);
  const Cut cut{params.samples, params.halvings, spread * spread};
  return sum_deltas(cut, sight.chain.last(), sight.quad, sight, source, sight.work);
}

template <class Source>
constexpr bool KEEPS = std::is_same_v<Source, TermCollector>;

// The sum of the light over all longer chains that begin with the chain of `sight`.
template <class Source>
auto sum_chains(const MirroredSight& sight, const Source& source) {
  const auto& [eye, vertex, patch, quad, chain, work] = sight;
  decltype(std::declval<SumOf<Source>>() * Rgb{}) total{};
  if (chain.mirrors.size() == static_cast<std::size_t>(eye.params.reflections)) return total;
  for (const Mirror& mirror : eye.mesh.mirrors) {
    if (!chain.can_meet(mirror)) continue;
    work[Op::light_mirrored] += 1;
    const Chain longer = chain.extend(mirror, eye.mesh.materials[mirror.material].reflectance);
    const MirroredSight further{eye, vertex, patch, quad, longer, work};
    std::size_t begun = 0;
    if constexpr (KEEPS<Source>) begun = source.begin(longer.mirrors.size(), longer.reflectance);
    if (face_each_other(longer.last(), patch) && longer.may_show(patch.at))
      total += eval_chain(further, source) * longer.reflectance;
    total += sum_chains(further, source);
    if constexpr (KEEPS<Source>) source.end(begun);
  }
  return total;
}

}  // namespace

Rgb eval_mirrored_light(const Eye& eye, const Vertex& vertex, const Sender& sender, Work& work) {
  const Chain none({vertex.lit, vertex.normal});
  const MirroredSight sight{eye, vertex, sender.patch, sender.quad, none, work};
  return sender.is_even ? sum_chains(sight, Even{}) * sender.glow.at
                        : sum_chains(sight, sender.glow);
}

void find_mirrored_terms(const Eye& eye, const Vertex& vertex, const Sender& sender, Terms& kept,
                         Work& work) {
  const Chain none({vertex.lit, vertex.normal});
  sum_chains({eye, vertex, sender.patch, sender.quad, none, work}, TermCollector{kept});
}

}  // namespace radiosity
