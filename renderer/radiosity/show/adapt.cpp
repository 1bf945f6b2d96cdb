#include "renderer/radiosity/show/adapt.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderer/radiosity/mesh/divide.hpp"
#include "renderer/radiosity/mesh/grade.hpp"
#include "renderer/radiosity/show/locate.hpp"
#include "renderer/radiosity/show/picture.hpp"
#include "renderer/scene/require.hpp"

namespace radiosity {

namespace {

// Fraction of the allowed mean square error that may remain in patches that are not halved.
constexpr double LEFT = 0.5;
// A patch is halved only along its longer side if this side is more than LONG times as long as the
// shorter one.
constexpr double LONG = 1.5;
// Rows are halved in only one direction if the light changes more than STEEP times as much in this
// direction as in the other.
constexpr double STEEP = 2;
// Limits of make_lit_mesh(): the number of rounds of halving, and the growth of the number of
// patches.
constexpr int MOST_HALVINGS = 2;
constexpr std::size_t MOST_GROWTH = 2;
// Number of attempts to halve patches while their number does not grow.
constexpr int MOST_TRIES = 4;
// Unsent fraction of the light at which the solutions between rounds end. It may be large, because
// the light that causes sharp edges is sent early. A mesh that seems good enough is tested again
// with the smaller fraction LESS.
constexpr double ROUGH = 0.2, LESS = 0.02;

// Mean square of the error over a patch, as a fraction of the squared error in its middle. For
// illumination that is quadratic along both sides, the fraction is between 4/9 and 8/15.
constexpr double SMOOTH = 0.5;

// Number of pixels along the longer side of the picture for the error estimate.
constexpr int SIDE = 256;

// The weight of each patch in the picture from the given view (see find_shares()).
std::vector<Rgb> find_weights(const Mesh& mesh, const renderer::View& view) {
  const double scale = std::min(1.0, static_cast<double>(SIDE) / std::max(view.width, view.height));
  const auto shorten = [&](int side) { return std::max(1, static_cast<int>(scale * side)); };
  return find_shares(mesh, view, {.width = shorten(view.width), .height = shorten(view.height)});
}

// The radiosity at the middle of a patch. It follows from the mean and the corners by Simpson's
// rule.
Rgb find_middle(const Mesh& mesh, const Solution& solution, std::uint32_t p) {
  Rgb corners;
  for (const auto corner : mesh.patches[p].corners) corners += solution.vertices[corner];
  return 1.5 * (solution.means[p] + -1.0 / 12 * corners);
}

// The computed light at a patch's middle, less the interpolated surface there. 0 for a patch of a
// curved surface, because the light at its middle is computed with the normal of the flat patch.
Rgb find_off(const Mesh& mesh, const Solution& solution, const Illumination& illumination,
             std::uint32_t p) {
  const Patch& patch = mesh.patches[p];
  const bool is_flat = std::ranges::all_of(patch.corners, [&](std::uint32_t corner) {
    return dot(mesh.vertices[corner].normal, patch.normal) > 1 - 1e-9;
  });
  if (!is_flat) return {};
  return find_middle(mesh, solution, p) + -1.0 * eval_illumination(illumination, p, 0.5, 0.5);
}

// The contribution of each patch to the picture's mean square error over the colours, estimated
// from the error at the patch's middle.
std::vector<double> find_errors(const Mesh& mesh, const Solution& solution,
                                const Illumination& illumination, const std::vector<Rgb>& weights) {
  std::vector<double> errors;
  for (std::uint32_t p = 0; p < mesh.patches.size(); ++p) {
    const Rgb off = find_off(mesh, solution, illumination, p);
    errors.push_back(SMOOTH * sum(weights[p] * off * off) / 3);
  }
  return errors;
}

// The patches where the interpolated surface differs from the computed light by more than
// MOST_OFF_HERE in the middle. The difference is relative to the light, including unsent light. The
// result is sorted by squared difference times area, largest first.
std::vector<std::uint32_t> find_patches_off(const Mesh& mesh, const Solution& solution) {
  const Illumination illumination = reconstruct(mesh, solution.vertices, {});
  std::vector<std::pair<double, std::uint32_t>> found;
  for (std::uint32_t p = 0; p < mesh.patches.size(); ++p) {
    const Material& material = mesh.materials[mesh.patches[p].material];
    if (max_component(material.emission) > 0) continue;
    const Rgb by = find_off(mesh, solution, illumination, p);
    const double off = std::abs(by.r) + std::abs(by.g) + std::abs(by.b);
    const Rgb middle = find_middle(mesh, solution, p) + material.reflectance * solution.ambient;
    const double light = std::max(0.0, sum(middle));
    if (off > MOST_OFF_HERE * light) found.emplace_back(off * off * mesh.patches[p].area, p);
  }
  std::ranges::stable_sort(found, std::greater{}, [](const auto& f) { return f.first; });
  std::vector<std::uint32_t> patches;
  for (const auto& [square, p] : found) patches.push_back(p);
  return patches;
}

// The mean square of the picture's radiosity over the colours, without emission. Assumes that
// unsent light is uniform.
double eval_mean_square(const Mesh& mesh, const Solution& solution,
                        const std::vector<Rgb>& weights) {
  double total = 0;
  for (std::uint32_t p = 0; p < mesh.patches.size(); ++p) {
    const Patch& patch = mesh.patches[p];
    const Material& material = mesh.materials[patch.material];
    if (max_component(material.emission) > 0) continue;
    const Rgb radiosity = solution.means[p] + material.reflectance * solution.ambient;
    total += sum(weights[p] * radiosity * radiosity) / 3;
  }
  return total;
}

// The patches with the largest errors, as many as needed so that the errors of all other patches
// add up to at most `allowed`.
std::vector<std::uint32_t> choose(const std::vector<double>& errors, double allowed) {
  std::vector<std::uint32_t> order(errors.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, std::greater{}, [&](std::uint32_t p) { return errors[p]; });
  double left = std::accumulate(errors.begin(), errors.end(), 0.0);
  std::size_t count = 0;
  while (count < order.size() && left > allowed) left -= errors[order[count++]];
  order.resize(count);
  return order;
}

// The extent of a patch in its face: the smallest and largest parameters of its corners.
struct Extent {
  Corner lo, hi;
};
Extent find_extent(const Face& face, const Patch& patch) {
  const Vec normal = normalize(eval_area_normal(face.corners));
  const Vec u = normalize(face.corners[1] - face.corners[0]), v = cross(normal, u);
  const auto flatten = [&](const Vec& p) {
    return Corner{dot(p - face.corners[0], u), dot(p - face.corners[0], v)};
  };
  std::array<Corner, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = flatten(face.corners[i]);
  Extent extent{{1, 1}, {0, 0}};
  for (const Vec& at : patch.at) {
    const Corner p = invert_bilinear(corners, flatten(at));
    extent.lo = {std::min(extent.lo.u, p.u), std::min(extent.lo.v, p.v)};
    extent.hi = {std::max(extent.hi.u, p.u), std::max(extent.hi.v, p.v)};
  }
  return extent;
}

// Marks each step between grid lines if more than a tenth of it lies in the interval from `from` to
// `to`. Also marks the step that contains the interval's middle.
void mark(const std::vector<double>& lines, double from, double to, std::vector<bool>& marks) {
  const double middle = (from + to) / 2;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const double common = std::min(to, lines[i + 1]) - std::max(from, lines[i]);
    if (common > 0.1 * (lines[i + 1] - lines[i]) || (lines[i] <= middle && middle < lines[i + 1]))
      marks[i] = true;
  }
}

// The rows of patches of a face that are to be halved, along and across the face.
struct Marks {
  std::vector<bool> along, across;
};

// The directions of a face in which the rows of one patch are halved.
struct Ways {
  bool along = false, across = false;
};

// The direction of a patch's longer side; both directions if the sides are of similar length.
Ways find_long_ways(const Face& face, const Patch& patch) {
  const auto [lo, hi] = find_extent(face, patch);
  const double wide = (hi.u - lo.u) * length(face.corners[1] - face.corners[0]);
  const double high = (hi.v - lo.v) * length(face.corners[3] - face.corners[0]);
  return {LONG * wide > high, LONG * high > wide};
}

// The direction in which the light of a patch's corners changes most; both directions if it changes
// similarly.
Ways find_steep_ways(const Face& face, const Patch& patch, const Solution& solution) {
  const Vec u = normalize(face.corners[1] - face.corners[0]);
  const Vec v = normalize(face.corners[3] - face.corners[0]);
  double along = 0, across = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    const Vec side = patch.at[next] - patch.at[i];
    const double step = std::abs(sum(solution.vertices[patch.corners[next]] +
                                     -1.0 * solution.vertices[patch.corners[i]])) /
                        length(side);
    along += step * std::abs(dot(side, u));
    across += step * std::abs(dot(side, v));
  }
  return {STEEP * along > across, STEEP * across > along};
}

// Halves the rows of the chosen patches. `find_ways(face, patch)` returns the directions.
void refine(Room& room, const Mesh& mesh, const std::vector<std::uint32_t>& chosen,
            const auto& find_ways) {
  std::vector<Marks> marks;
  for (const Face& face : room.faces)
    marks.push_back(
        {std::vector<bool>(face.grid.along.size()), std::vector<bool>(face.grid.across.size())});
  std::vector<bool> everywhere(room.faces.size());
  for (const auto p : chosen) {
    const Patch& patch = mesh.patches[p];
    const Face& face = room.faces[patch.face];
    if (face.corners.size() != 4) {
      everywhere[patch.face] = true;
      continue;
    }
    const auto [lo, hi] = find_extent(face, patch);
    const Ways ways = find_ways(face, patch);
    if (ways.along) mark(face.grid.along, lo.u, hi.u, marks[patch.face].along);
    if (ways.across) mark(face.grid.across, lo.v, hi.v, marks[patch.face].across);
  }
  for (std::size_t f = 0; f < room.faces.size(); ++f) {
    Face& face = room.faces[f];
    if (everywhere[f]) face.along = face.across = 2 * face.along;
    if (face.grid.along.empty()) continue;
    halve(face.grid.along, marks[f].along);
    halve(face.grid.across, marks[f].across);
  }
}

// Halves the chosen patches. Returns none if there are too many patches afterwards, or not more
// than before. Tries again, because new grid lines are dropped if they are too near to a contact or
// crease.
std::optional<Mesh> make_finer(Room& room, const MeshParams& params, const Mesh& mesh,
                               const std::vector<std::uint32_t>& chosen) {
  for (int tries = 0; tries < MOST_TRIES; ++tries) {
    refine(room, mesh, chosen, find_long_ways);
    Mesh finer = make_mesh(room, params);
    if (finer.patches.size() > MOST_ADAPTED) return {};
    if (finer.patches.size() > mesh.patches.size()) return finer;
  }
  return {};
}

// Stores the rows of patches in the faces, for adapt_mesh() to halve them where the solution needs
// it.
void prepare_rounds(Room& room, int refine) {
  for (Face& face : room.faces) {
    if (face.corners.size() == 4) face.grid = find_grid(face, refine);
    face.along *= refine;
    face.across *= refine;
  }
  room.fine_near_lights = false;
}

}  // namespace

base::Field<AdaptParams> adaptive_field() {
  return base::Declare<AdaptParams>::number(
      "adaptive", &AdaptParams::error, 0, 1, "",
      "halve patches where the illumination varies until the estimated relative error of the "
      "picture (root mean square) is at most this; 0: never");
}

AdaptedMesh adapt_mesh(Room room, const LightParams& params,
                       const ReconstructionParams& reconstruction, const AdaptParams& adapt,
                       const Step& step) {
  renderer::require(params.solve.mean == Mean::simpson, "adaptive patches with the mean of corners",
                    "the mean of corners and centres (simpson)");
  renderer::require(adapt.error >= LEAST_ERROR, fmt::format("an error of {}", adapt.error),
                    fmt::format("{} to 1", LEAST_ERROR));
  prepare_rounds(room, params.mesh.refine);
  MeshParams parts = params.mesh;
  parts.refine = 1;
  SolveParams rough = params.solve;
  rough.tolerance = std::max(params.solve.tolerance, ROUGH);
  AdaptedMesh adapted{make_mesh(room, parts), 0, 0, {}};
  adapted.rough = solve(adapted.mesh, rough, step);
  for (;;) {
    const Mesh& mesh = adapted.mesh;
    const Solution& solution = adapted.rough;
    const auto weights = find_weights(mesh, room.view);
    const auto errors =
        find_errors(mesh, solution, reconstruct(mesh, solution.vertices, reconstruction), weights);
    const double square = eval_mean_square(mesh, solution, weights);
    const double total = std::accumulate(errors.begin(), errors.end(), 0.0);
    const double allowed = adapt.error * adapt.error * square;
    // Only lamps are visible if `square` is 0.
    adapted.error = square > 0 ? std::sqrt(total / square) : 0;
    if (!(square > 0 && total > allowed)) {
      if (rough.tolerance <= std::max(params.solve.tolerance, LESS)) return adapted;
      rough.tolerance = std::max(params.solve.tolerance, LESS);
      adapted.rough = solve_further(mesh, rough, std::move(adapted.rough), step);
      continue;
    }
    if (adapted.rounds == MOST_ROUNDS) return adapted;
    const auto chosen = choose(errors, LEFT * allowed);
    auto finer = make_finer(room, parts, mesh, chosen);
    if (!finer) return adapted;
    adapted.mesh = std::move(*finer);
    adapted.rough = solve(adapted.mesh, rough, step);
    ++adapted.rounds;
  }
}

namespace {

// Halves the rows of the chosen patches. If the room then has more than `most` patches, drops the
// last half of the choice and tries again.
Room halve_some(const Room& room, const AdaptedMesh& adapted, std::vector<std::uint32_t> chosen,
                int refined, std::size_t most) {
  for (; !chosen.empty(); chosen.resize(chosen.size() / 2)) {
    Room finer = room;
    for (Face& face : finer.faces)
      if (face.corners.size() == 4) face.grid = find_grid(face, refined);
    refine(finer, adapted.mesh, chosen, [&](const Face& face, const Patch& patch) {
      return find_steep_ways(face, patch, adapted.rough);
    });
    if (count_patches(finer, refined) <= most) return finer;
  }
  return room;
}

}  // namespace

AdaptedMesh make_lit_mesh(const Room& given, const LightParams& params, const Step& step) {
  if (!given.fine_near_lights || params.senders > 0 || params.solve.mean != Mean::simpson)
    return {make_mesh(given, params.mesh), 0, 0, {}};
  Room room = make_graded(given, params.mesh.refine);
  room.fine_near_lights = false;
  const std::size_t most = MOST_GROWTH * count_patches(room, params.mesh.refine);
  SolveParams rough = params.solve;
  rough.tolerance = std::max(params.solve.tolerance, ROUGH);
  AdaptedMesh adapted{make_mesh(room, params.mesh), 0, 0, {}};
  for (;; ++adapted.rounds) {
    adapted.rough = solve(adapted.mesh, rough, step);
    if (adapted.rounds == MOST_HALVINGS) return adapted;
    auto chosen = find_patches_off(adapted.mesh, adapted.rough);
    std::erase_if(chosen, [&](std::uint32_t p) {
      return room.faces[adapted.mesh.patches[p].face].corners.size() != 4;
    });
    if (chosen.empty()) return adapted;
    Room finer = halve_some(room, adapted, std::move(chosen), params.mesh.refine, most);
    Mesh mesh = make_mesh(finer, params.mesh);
    if (mesh.patches.size() <= adapted.mesh.patches.size()) return adapted;
    room = std::move(finer);
    adapted.mesh = std::move(mesh);
  }
}

double estimate_error(const Mesh& mesh, const Solution& solution, const SolveParams& params,
                      const ReconstructionParams& reconstruction, const renderer::View& view) {
  if (params.mean != Mean::simpson) return 0;
  const auto weights = find_weights(mesh, view);
  const auto errors =
      find_errors(mesh, solution, reconstruct(mesh, solution.vertices, reconstruction), weights);
  const double square = eval_mean_square(mesh, solution, weights);
  return square > 0 ? std::sqrt(std::accumulate(errors.begin(), errors.end(), 0.0) / square) : 0;
}

Solution solve_adapted(const Room& room, AdaptedMesh& adapted, const LightParams& params,
                       const Step& step) {
  return params.senders > 0 ? solve_room(room, adapted.mesh, params, step)
         : adapted.rough.means.empty()
             ? solve(adapted.mesh, params.solve, step)
             : solve_further(adapted.mesh, params.solve, std::move(adapted.rough), step);
}

}  // namespace radiosity
