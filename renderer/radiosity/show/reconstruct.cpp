#include "renderer/radiosity/show/reconstruct.hpp"

#include <map>

#include "renderer/radiosity/show/limit.hpp"
#include "renderer/radiosity/show/seams.hpp"
#include "renderer/scene/require.hpp"

namespace radiosity {
namespace {

// The parameters s and t of a patch's four corners, in order.
constexpr std::size_t S[] = {0, 1, 1, 0}, T[] = {0, 0, 1, 1};

// Where the matrix G_H (thesis Eq 3.4), stored by rows, holds the value and the derivatives at the
// corner (s, t).
struct Slots {
  std::size_t value, by_s, by_t, by_st;
};
constexpr Slots find_slots(std::size_t s, std::size_t t) {
  return {4 * s + t, 4 * (s + 2) + t, 4 * s + t + 2, 4 * (s + 2) + t + 2};
}

// Stores the value at a corner in `g`, and the derivatives by s and t. These follow from the
// changes along the edges to the next and previous corners; an edge runs along s or t, in either
// direction.
void set_corner(std::span<Rgb> g, std::uint32_t corner, const Rgb& value, const Rgb& to_next,
                const Rgb& to_prev) {
  const std::size_t s = S[corner], t = T[corner];
  const bool next_is_s = corner % 2 == 0;
  const Slots at = find_slots(s, t);
  g[at.value] = value;
  g[at.by_s] = (s == 0 ? 1.0 : -1.0) * (next_is_s ? to_next : to_prev);
  g[at.by_t] = (t == 0 ? 1.0 : -1.0) * (next_is_s ? to_prev : to_next);
}

// The Hermite basis S M_H of thesis Eq 3.2 and 3.3.
std::array<double, 4> eval_hermite_basis(double s) {
  const double s2 = s * s, s3 = s2 * s;
  return {2 * s3 - 3 * s2 + 1, 3 * s2 - 2 * s3, s3 - 2 * s2 + s, s3 - s2};
}

// The derivative of the Hermite basis by s.
std::array<double, 4> eval_hermite_slopes(double s) {
  const double s2 = s * s;
  return {6 * s2 - 6 * s, 6 * s - 6 * s2, 3 * s2 - 4 * s + 1, 3 * s2 - 2 * s};
}

// Computes the matrix G_H (thesis Eq 3.4) of every patch.
class Bicubic {
 public:
  Bicubic(const Mesh& mesh, std::span<const Rgb> vertices, const ReconstructionParams& params)
      : mesh_(mesh),
        params_(params),
        fans_(make_fans(mesh)),
        vertices_(vertices.begin(), vertices.end()),
        slopes_(find_slopes(mesh, fans_, vertices)),
        limits_(find_limits(mesh, fans_, vertices)) {}

  // Processes vertex by vertex: each corner of a patch belongs to one vertex.
  std::vector<Rgb> make() {
    for (const Seam& seam : find_seams(mesh_, fans_.twins)) close(seam);
    std::vector<Rgb> values(16 * mesh_.patches.size());
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
      Slopes<Slopes<Rgb>> bend;
      if (params_.twist == Twist::estimated) bend = find_bend(mesh_, fans_, slopes_, v);
      for (const Wedge& wedge : fans_.at(v))
        set_corners(std::span(values).subspan(16 * std::size_t{wedge.patch}, 16), v, wedge, bend);
    }
    return values;
  }

 private:
  // The derivative along an edge at its beginning, multiplied by the length of the edge.
  Rgb find_change(std::uint32_t from, std::uint32_t to) const {
    const auto fixed = fixed_.find({from, to});
    if (fixed != fixed_.end()) return fixed->second;
    const auto step = [&](std::uint32_t v, std::uint32_t end) {
      return along(slopes_[v], unfold(mesh_.vertices[v], mesh_.vertices[end].at));
    };
    if (!params_.limited) return step(from, to);
    return limit_change(limits_[from], vertices_[from], step(from, to),
                        vertices_[to] + -1.0 * vertices_[from], -1.0 * step(to, from));
  }

  // Makes the illumination along all short edges of a seam follow the cubic of the long edge.
  void close(const Seam& seam) {
    const Rgb ends[] = {vertices_[seam.from], vertices_[seam.to], find_change(seam.from, seam.to),
                        -1.0 * find_change(seam.to, seam.from)};
    const auto eval = [&](const std::array<double, 4>& basis) {
      Rgb sum;
      for (std::size_t i = 0; i < 4; ++i) sum += basis[i] * ends[i];
      return sum;
    };
    const auto fix = [&](const Seam::Stop& from, const Seam::Stop& to) {
      fix_change(from.vertex, to.vertex,
                 (to.share - from.share) * eval(eval_hermite_slopes(from.share)));
    };
    std::vector<Seam::Stop> stops{{seam.from, 0}};
    stops.insert(stops.end(), seam.stops.begin(), seam.stops.end());
    stops.push_back({seam.to, 1});
    for (std::size_t i = 0; i < stops.size(); ++i) {
      const auto &here = stops[i], &next = stops[(i + 1) % stops.size()];
      for_twins(fans_.twins, here.vertex,
                [&](std::uint32_t v) { vertices_[v] = eval(eval_hermite_basis(here.share)); });
      fix(here, next);
      fix(next, here);
    }
  }

  void fix_change(std::uint32_t from, std::uint32_t to, const Rgb& change) {
    for_twins(fans_.twins, from, [&](std::uint32_t a) {
      for_twins(fans_.twins, to, [&](std::uint32_t b) { fixed_[{a, b}] = change; });
    });
  }

  // Sets the values at those corners of a patch that are at the vertex.
  void set_corners(std::span<Rgb> g, std::uint32_t vertex, const Wedge& wedge,
                   const Slopes<Slopes<Rgb>>& bend) const {
    const auto& corners = mesh_.patches[wedge.patch].corners;
    for (std::uint32_t c = wedge.corner; c < 4; ++c) {
      if (corners[c] != vertex) continue;
      const std::uint32_t next = corners[(c + 1) % 4], prev = corners[(c + 3) % 4];
      const Rgb &value = vertices_[vertex], to_next = find_change(vertex, next),
                to_prev = find_change(vertex, prev);
      set_corner(g, c, value, to_next, to_prev);
      const Slots at = find_slots(S[c], T[c]);
      const double sign = S[c] == T[c] ? 1.0 : -1.0;
      Rgb twist;
      // The thesis says "substituting s + t for d": in the direction s + t, the slopes by s and t
      // add up.
      if (params_.twist == Twist::diagonal) twist = sign * (g[at.by_s] + g[at.by_t]);
      if (params_.twist == Twist::estimated && next != vertex && prev != vertex)
        twist = find_twist(mesh_, wedge, slopes_[vertex], bend);
      if (params_.limited) twist = limit_twist(limits_[vertex], value, to_next, to_prev, twist);
      g[at.by_st] = sign * twist;
    }
  }

  const Mesh& mesh_;
  const ReconstructionParams& params_;
  Fans fans_;
  std::vector<Rgb> vertices_;
  std::vector<Slopes<Rgb>> slopes_;
  std::vector<Limits> limits_;
  // Prescribed changes along the edges of seams, by the two ends of the edge.
  std::map<std::pair<std::uint32_t, std::uint32_t>, Rgb> fixed_;
};

// Changes the illumination at the vertices on seams so that it is linear along each seam.
std::vector<Rgb> close_seams(const Mesh& mesh, std::span<const Rgb> vertices) {
  std::vector<Rgb> closed(vertices.begin(), vertices.end());
  const auto twins = find_twins(mesh);
  for (const Seam& seam : find_seams(mesh, twins))
    for (const auto& [vertex, share] : seam.stops)
      for_twins(twins, vertex, [&](std::uint32_t v) {
        closed[v] = (1 - share) * closed[seam.from] + share * closed[seam.to];
      });
  return closed;
}

std::vector<Rgb> make_corners(const Mesh& mesh, std::span<const Rgb> vertices, bool flat) {
  std::vector<Rgb> values;
  values.reserve(4 * mesh.patches.size());
  for (const Patch& patch : mesh.patches) {
    Rgb sum;
    for (const std::uint32_t v : patch.corners) sum += vertices[v];
    for (const std::uint32_t v : patch.corners) values.push_back(flat ? 0.25 * sum : vertices[v]);
  }
  return values;
}

}  // namespace

base::Fields<ReconstructionParams> reconstruction_fields() {
  using D = base::Declare<ReconstructionParams>;
  static const base::Names<Reconstruction> KINDS = {{"bilinear", Reconstruction::bilinear},
                                                    {"bicubic", Reconstruction::bicubic},
                                                    {"flat", Reconstruction::flat}};
  static const base::Names<Twist> TWISTS = {
      {"estimated", Twist::estimated}, {"diagonal", Twist::diagonal}, {"zero", Twist::zero}};
  return {D::choice("reconstruction", &ReconstructionParams::kind, KINDS,
                    "interpolation of illumination between vertices"),
          D::choice("twist", &ReconstructionParams::twist, TWISTS,
                    "the mixed derivatives of bicubic surfaces"),
          D::flag("limited", &ReconstructionParams::limited,
                  "true: limit a bicubic surface to values near those at its vertices")};
}

Illumination reconstruct(const Mesh& mesh, std::span<const Rgb> vertices,
                         const ReconstructionParams& params) {
  renderer::require(vertices.size() == mesh.vertices.size(),
                    fmt::format("{} illuminations", vertices.size()),
                    fmt::format("{}, one for each vertex", mesh.vertices.size()));
  if (params.kind == Reconstruction::bicubic)
    return {params.kind, Bicubic(mesh, vertices, params).make()};
  if (params.kind == Reconstruction::bilinear)
    return {params.kind, make_corners(mesh, close_seams(mesh, vertices), false)};
  return {params.kind, make_corners(mesh, vertices, true)};
}

Rgb eval_hermite(std::span<const Rgb, 16> g, double s, double t) {
  const auto hs = eval_hermite_basis(s), ht = eval_hermite_basis(t);
  Rgb sum;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) sum += hs[i] * ht[j] * g[4 * i + j];
  return sum;
}

Rgb eval_illumination(const Illumination& illumination, std::uint32_t patch, double s, double t) {
  const std::span<const Rgb> values = illumination.values;
  Rgb sum;
  if (illumination.kind == Reconstruction::bicubic) {
    sum = eval_hermite(values.subspan(16 * std::size_t{patch}).first<16>(), s, t);
  } else {
    const auto corners = values.subspan(4 * std::size_t{patch}, 4);
    for (std::size_t i = 0; i < 4; ++i) sum += (S[i] ? s : 1 - s) * (T[i] ? t : 1 - t) * corners[i];
  }
  return {std::max(0.0, sum.r), std::max(0.0, sum.g), std::max(0.0, sum.b)};
}

}  // namespace radiosity
