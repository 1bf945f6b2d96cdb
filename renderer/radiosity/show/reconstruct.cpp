#include "renderer/radiosity/show/reconstruct.hpp"

#include "renderer/radiosity/show/limit.hpp"
#include "renderer/scene/require.hpp"

namespace radiosity {
namespace {

// The parameters of a patch's corners, in their order.
constexpr std::size_t S[] = {0, 1, 1, 0}, T[] = {0, 0, 1, 1};

// Indices of the value and the derivatives of a corner (s, t), each 0 or 1, in G_H, by rows
// (Eq 3.4).
struct Slots {
  std::size_t value, by_s, by_t, by_st;
};
constexpr Slots find_slots(std::size_t s, std::size_t t) {
  return {4 * s + t, 4 * (s + 2) + t, 4 * s + t + 2, 4 * (s + 2) + t + 2};
}

// Sets a corner's value and its derivatives by s and t, from those along its edges to the next
// corner and to the previous one: edges run along s or t, up or down.
void set_corner(std::span<Rgb> g, std::uint32_t corner, const Rgb& value, const Rgb& to_next,
                const Rgb& to_prev) {
  const std::size_t s = S[corner], t = T[corner];
  const bool next_is_s = corner % 2 == 0;
  const Slots at = find_slots(s, t);
  g[at.value] = value;
  g[at.by_s] = (s == 0 ? 1.0 : -1.0) * (next_is_s ? to_next : to_prev);
  g[at.by_t] = (t == 0 ? 1.0 : -1.0) * (next_is_s ? to_prev : to_next);
}

// G_H of every patch, set vertex by vertex: every corner of every patch belongs to one.
std::vector<Rgb> make_bicubic(const Mesh& mesh, std::span<const Rgb> vertices,
                              const ReconstructionParams& params) {
  const Fans fans = make_fans(mesh);
  std::vector<Slopes<Rgb>> slopes = find_slopes(mesh, fans, vertices);
  const std::vector<Limits> limits = find_limits(mesh, fans, vertices, params.overshoot);
  limit_slopes(mesh, fans, vertices, limits, slopes);
  std::vector<Rgb> values(16 * mesh.patches.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    Slopes<Slopes<Rgb>> bend;
    if (params.twist == Twist::estimated) bend = find_bend(mesh, fans, slopes, v);
    for (const Wedge& w : fans.at(v)) {
      const std::span<Rgb> g = std::span(values).subspan(16 * std::size_t{w.patch}, 16);
      const auto& corners = mesh.patches[w.patch].corners;
      const auto change = [&](std::uint32_t to) {
        return along(slopes[v], unfold(mesh.vertices[v], mesh.vertices[to].at));
      };
      for (std::uint32_t c = w.corner; c < 4; ++c) {
        if (corners[c] != v) continue;
        const std::uint32_t next = corners[(c + 1) % 4], prev = corners[(c + 3) % 4];
        const Rgb to_next = change(next), to_prev = change(prev);
        set_corner(g, c, vertices[v], to_next, to_prev);
        const Slots at = find_slots(S[c], T[c]);
        const double sign = S[c] == T[c] ? 1.0 : -1.0;
        Rgb twist;
        // "Substituting s + t for d": along s + t the slopes by s and by t add up.
        if (params.twist == Twist::diagonal) twist = sign * (g[at.by_s] + g[at.by_t]);
        if (params.twist == Twist::estimated && next != v && prev != v)
          twist = find_twist(mesh, w, slopes[v], bend);
        g[at.by_st] = sign * limit_twist(limits[v], vertices[v], to_next, to_prev, twist);
      }
    }
  }
  return values;
}

// S M_H, Eq 3.2 and 3.3.
std::array<double, 4> eval_hermite_basis(double s) {
  const double s2 = s * s, s3 = s2 * s;
  return {2 * s3 - 3 * s2 + 1, 3 * s2 - 2 * s3, s3 - 2 * s2 + s, s3 - s2};
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
                    "how illumination is interpolated between vertices"),
          D::choice("twist", &ReconstructionParams::twist, TWISTS,
                    "the mixed derivatives of bicubic surfaces"),
          D::number("overshoot", &ReconstructionParams::overshoot, 0, 1e9, "",
                    "by which share of the range of the illumination around a vertex a bicubic "
                    "surface may go beyond it there")};
}

Illumination reconstruct(const Mesh& mesh, std::span<const Rgb> vertices,
                         const ReconstructionParams& params) {
  renderer::require(vertices.size() == mesh.vertices.size(),
                    fmt::format("{} illuminations", vertices.size()),
                    fmt::format("one for each of {} vertices", mesh.vertices.size()));
  if (params.kind == Reconstruction::bicubic)
    return {params.kind, make_bicubic(mesh, vertices, params)};
  return {params.kind, make_corners(mesh, vertices, params.kind == Reconstruction::flat)};
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
