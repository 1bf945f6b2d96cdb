#include "renderer/radiosity/light/solve.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "renderer/radiosity/light/receivers.hpp"
#include "renderer/radiosity/light/rows.hpp"

namespace radiosity {

using renderer::LANES;
using renderer::Op;
using renderer::Work;

namespace {

// Upper limit of a patch's unsent power, in units of Unshot. A sum over a million patches does not
// overflow.
constexpr double MOST_UNSHOT = 0x1p42;

// Limit on the memory in bytes for the form factors kept during a solution.
constexpr std::size_t MOST_KEPT = std::size_t{1} << 30;

std::vector<std::uint32_t> count_up(std::size_t n) {
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

// Calls f with consecutive groups of LANES indices. The last group may be smaller.
template <class F>
void for_lanes(std::span<const std::uint32_t> all, const F& f) {
  for (std::size_t begin = 0; begin < all.size(); begin += LANES)
    f(all.subspan(begin, std::min(LANES, all.size() - begin)));
}

// The mean light that arrived at patch `p` in the last shot, estimated as `mean` says.
Rgb eval_mean(const Mesh& mesh, std::uint32_t p, Mean mean, const State& state) {
  Rgb corners;
  for (const auto corner : mesh.patches[p].corners) corners += state.received[corner];
  if (mean == Mean::corners) return 0.25 * corners;
  return (1.0 / 12) * corners + (2.0 / 3) * state.in_centre[p];
}

// The fraction of a patch's area that belongs to each corner, by bilinear weights.
std::array<double, 4> eval_shares(const Patch& patch) {
  const Quad quad(patch);
  const auto eval = [&](double s, double t) {
    // `of_s` is an integral over s from 0 to 1: the corner's weight along s, multiplied by s.
    // `of_t` is the same integral along t.
    const double of_s = (1 + s) / 6, of_t = (1 + t) / 6;
    return (quad.density / 4 + quad.by_s * of_s / 2 + quad.by_t * of_t / 2) /
           (quad.density + quad.by_s / 2 + quad.by_t / 2);
  };
  return {eval(0, 0), eval(1, 0), eval(1, 1), eval(0, 1)};
}

// Changes the unsent light at a patch's corners so that its mean over the patch becomes `mean`. If
// light is missing, all corners get the same additional amount. If there is too much, all corners
// are reduced in the same proportion.
Glow fit_glow(const Patch& patch, std::array<Rgb, 4> corners, const Rgb& mean) {
  const auto shares = eval_shares(patch);
  for (double Rgb::*colour : {&Rgb::r, &Rgb::g, &Rgb::b}) {
    double found = 0;
    for (std::size_t k = 0; k < 4; ++k) found += shares[k] * corners[k].*colour;
    const double missing = mean.*colour - found;
    for (Rgb& corner : corners)
      corner.*colour = missing > 0 ? corner.*colour + missing
                                   : corner.*colour * (found > 0 ? mean.*colour / found : 0);
  }
  return Glow(corners);
}

Glow find_glow(const Mesh& mesh, const State& state, std::uint32_t p) {
  if (state.in_corners.empty()) return Glow(state.unshot[p]);
  return fit_glow(mesh.patches[p], state.in_corners[p], state.unshot[p]);
}

std::vector<Vertex> make_centres(const Mesh& mesh) {
  std::vector<Vertex> centres;
  for (const Patch& patch : mesh.patches) centres.push_back(make_centre(patch));
  return centres;
}

// Adds the light that arrives at all vertices to `state`, as receive() does.
void take(const Mesh& mesh, std::span<const Rgb> lights, State& state, Work& work) {
  for (std::size_t v = 0; v < lights.size(); ++v) {
    state.received[v] = lights[v];
    state.radiosity[v] += mesh.materials[mesh.vertices[v].material].reflectance * lights[v];
  }
  work[Op::vertex_lit] += lights.size();
}

// Repeats shots until the solution ends, as described for solve(). `fine` may be null.
Solution shoot_until(const Mesh& mesh, const SolveParams& params, Solution solution,
                     const Step& step, const Mesh* fine) {
  check(params.factor);
  const auto patches = all_patches(mesh);
  const Eye eye{mesh, params.factor}, fine_eye{fine ? *fine : mesh, params.factor};
  std::size_t room = MOST_KEPT;
  Rows to_vertices(eye, mesh.vertices, room);
  Rows to_fine(fine_eye, fine ? fine->vertices : std::vector<Vertex>{}, room);
  Rows to_centres(eye, params.mean == Mean::simpson ? make_centres(mesh) : std::vector<Vertex>{},
                  room);
  State& state = solution.state;
  State fine_state = fine ? make_state(*fine, Sends::mean) : State{};
  Work& work = solution.work;
  for (;; ++solution.shots) {
    const Unshot unshot = sum_unshot(mesh, state, patches);
    solution.unshot = eval_share(unshot);
    solution.ambient = eval_ambient(mesh, unshot);
    if (step && !step(solution.shots, solution.unshot)) break;
    if (solution.shots >= params.shots || solution.unshot <= params.tolerance) break;
    const auto shot = find_shot(mesh, state, patches, work);
    if (!shot) break;
    const Sender sender(mesh.patches[shot->patch], shot->glow);
    take(mesh, to_vertices.eval(shot->patch, sender, work), state, work);
    if (fine) take(*fine, to_fine.eval(shot->patch, sender, work), fine_state, work);
    if (params.mean == Mean::simpson) {
      std::ranges::copy(to_centres.eval(shot->patch, sender, work), state.in_centre.begin());
      work[Op::vertex_lit] += patches.size();
    }
    settle(mesh, *shot, patches, params.mean, state, work);
  }
  solution.means.clear();
  for (const auto p : patches) {
    const Material& material = mesh.materials[mesh.patches[p].material];
    solution.means.push_back(material.emission + material.reflectance * state.arrived[p]);
  }
  solution.balance = eval_balance(mesh, state.arrived, state.unshot);
  solution.vertices = fine ? std::move(fine_state.radiosity) : state.radiosity;
  return solution;
}

}  // namespace

Vertex make_centre(const Patch& patch) {
  return {patch.centre, patch.centre, patch.normal, patch.material, patch.object};
}

std::vector<std::uint32_t> all_vertices(const Mesh& mesh) { return count_up(mesh.vertices.size()); }
std::vector<std::uint32_t> all_patches(const Mesh& mesh) { return count_up(mesh.patches.size()); }

State make_state(const Mesh& mesh, Sends sends) {
  State state;
  for (const Vertex& v : mesh.vertices)
    state.radiosity.push_back(mesh.materials[v.material].emission);
  for (const Patch& p : mesh.patches) {
    state.unshot.push_back(mesh.materials[p.material].emission);
    state.areas.push_back(p.area);
  }
  if (sends == Sends::corners)
    for (const Rgb& unshot : state.unshot)
      state.in_corners.push_back({unshot, unshot, unshot, unshot});
  state.received.resize(mesh.vertices.size());
  state.in_centre.resize(mesh.patches.size());
  state.arrived.resize(mesh.patches.size());
  return state;
}

std::optional<Shot> find_shot(const Mesh& mesh, const State& state,
                              std::span<const std::uint32_t> patches, Work& work) {
  Shot best;
  for (const auto patch : patches) {
    const double power = sum(state.unshot[patch]) * state.areas[patch];
    if (power > best.power) best = {patch, {}, power};
  }
  work[Op::patch_compared] += patches.size();
  if (best.power <= 0) return std::nullopt;
  best.glow = find_glow(mesh, state, best.patch);
  return best;
}

void receive(const Eye& eye, const Sender& sender, std::span<const std::uint32_t> vertices,
             State& state, Work& work) {
  for_lanes(vertices, [&](std::span<const std::uint32_t> some) {
    Receivers receivers{};
    for (std::size_t k = 0; k < some.size(); ++k) receivers[k] = &eye.mesh.vertices[some[k]];
    const Lights lights = eval_lights(eye, receivers, sender, work);
    for (std::size_t k = 0; k < some.size(); ++k) {
      state.received[some[k]] = lights[k];
      state.radiosity[some[k]] +=
          eye.mesh.materials[receivers[k]->material].reflectance * lights[k];
    }
  });
  work[Op::vertex_lit] += vertices.size();
}

void receive_in_centres(const Eye& eye, const Sender& sender,
                        std::span<const std::uint32_t> patches, State& state, Work& work) {
  for_lanes(patches, [&](std::span<const std::uint32_t> some) {
    std::array<Vertex, LANES> centres;
    Receivers receivers{};
    for (std::size_t k = 0; k < some.size(); ++k) {
      centres[k] = make_centre(eye.mesh.patches[some[k]]);
      receivers[k] = &centres[k];
    }
    const Lights lights = eval_lights(eye, receivers, sender, work);
    for (std::size_t k = 0; k < some.size(); ++k) state.in_centre[some[k]] = lights[k];
  });
  work[Op::vertex_lit] += patches.size();
}

void settle(const Mesh& mesh, const Shot& shot, std::span<const std::uint32_t> patches, Mean mean,
            State& state, Work& work) {
  for (const auto p : patches) {
    const Patch& patch = mesh.patches[p];
    const Rgb& reflectance = mesh.materials[patch.material].reflectance;
    if (p == shot.patch) state.unshot[p] = {};
    const Rgb arrived = eval_mean(mesh, p, mean, state);
    state.arrived[p] += arrived;
    state.unshot[p] += reflectance * arrived;
    if (state.in_corners.empty()) continue;
    if (p == shot.patch) state.in_corners[p] = {};
    for (std::size_t k = 0; k < 4; ++k)
      state.in_corners[p][k] += reflectance * state.received[patch.corners[k]];
  }
  work[Op::patch_lit] += patches.size();
  if (!state.in_corners.empty()) work[Op::corner_lit] += 4 * patches.size();
}

Unshot& Unshot::operator+=(const Unshot& other) {
  r += other.r;
  g += other.g;
  b += other.b;
  return *this;
}

Unshot sum_unshot(const Mesh& mesh, const State& state, std::span<const std::uint32_t> patches) {
  Unshot total;
  const double unit = Unshot::ONE / sum(mesh.emitted);
  for (const auto p : patches) {
    const Rgb power = unit * state.areas[p] * state.unshot[p];
    // Rounds halves away from zero, as std::llround() does. The library function would dominate the
    // cost.
    const auto round = [](double share) {
      return static_cast<std::int64_t>(std::clamp(share, -MOST_UNSHOT, MOST_UNSHOT) +
                                       std::copysign(0.5, share));
    };
    total += {round(power.r), round(power.g), round(power.b)};
  }
  return total;
}

double eval_share(const Unshot& unshot) {
  return static_cast<double>(unshot.r + unshot.g + unshot.b) / Unshot::ONE;
}

Rgb eval_ambient(const Mesh& mesh, const Unshot& unshot) {
  const double unit = sum(mesh.emitted) / Unshot::ONE / mesh.area;
  const auto ambient = [&](std::int64_t unsent, double reflectance) {
    return unit * static_cast<double>(unsent) / (1 - reflectance);
  };
  return {ambient(unshot.r, mesh.reflectance.r), ambient(unshot.g, mesh.reflectance.g),
          ambient(unshot.b, mesh.reflectance.b)};
}

void add_ambient(const Mesh& mesh, const Rgb& ambient, std::vector<Rgb>& vertices) {
  for (std::size_t v = 0; v < vertices.size(); ++v)
    vertices[v] += mesh.materials[mesh.vertices[v].material].reflectance * ambient;
}

base::Fields<SolveParams> solve_fields() {
  using D = base::Declare<SolveParams>;
  static const base::Names<Mean> MEANS = {{"simpson", Mean::simpson}, {"corners", Mean::corners}};
  static const base::Names<Sends> SENDS = {{"corners", Sends::corners}, {"mean", Sends::mean}};
  return base::join(
      base::lift_all<SolveParams>(factor_fields(), &SolveParams::factor),
      {{D::choice("mean", &SolveParams::mean, MEANS,
                  "light received by a patch: Simpson's rule, a twelfth of each corner's plus two "
                  "thirds of the centre's; or the mean of its corners"),
        D::choice("sends", &SolveParams::sends, SENDS,
                  "light sent by a patch: bilinear between its corners, or everywhere their mean"),
        D::whole("max_shots", &SolveParams::shots, 0, 1e9, "",
                 "largest number of shots; in each, one patch sends its light"),
        D::number("tolerance", &SolveParams::tolerance, 0, 1, "",
                  "share of the emitted power that may remain unsent")}});
}

Solution solve(const Mesh& mesh, const SolveParams& params, const Step& step, const Mesh* fine) {
  Solution none;
  none.state = make_state(mesh, params.sends);
  return shoot_until(mesh, params, std::move(none), step, fine);
}

Solution solve_further(const Mesh& mesh, const SolveParams& params, Solution begun,
                       const Step& step) {
  return shoot_until(mesh, params, std::move(begun), step, nullptr);
}

base::Field<LightParams> senders_field() {
  return base::Declare<LightParams>::whole(
      "senders", &LightParams::senders, 0, 1000, "",
      "`refine` of coarser patches that send light to the vertices of the finer ones; 0: the finer "
      "patches send it");
}

Solution solve_room(const Room& room, const Mesh& mesh, const LightParams& params,
                    const Step& step) {
  if (params.senders == 0) return solve(mesh, params.solve, step);
  MeshParams coarse = params.mesh;
  coarse.refine = params.senders;
  Room even = room;  // the patches that send light need not be finer near lights
  even.fine_near_lights = false;
  return solve(make_mesh(even, coarse), params.solve, step, &mesh);
}

LitRoom light_room(const Room& room, const LightParams& params) {
  LitRoom lit{make_mesh(room, params.mesh), {}};
  Solution solution = solve_room(room, lit.mesh, params);
  lit.vertices = std::move(solution.vertices);
  if (params.ambient) add_ambient(lit.mesh, solution.ambient, lit.vertices);
  return lit;
}

double eval_mean_radiosity(const LitRoom& lit, const Mesh& other) {
  std::set<std::string> shared;
  for (const Patch& patch : other.patches) shared.insert(other.materials[patch.material].name);
  double sum = 0, area = 0;
  for (const Patch& patch : lit.mesh.patches) {
    if (!shared.contains(lit.mesh.materials[patch.material].name)) continue;
    area += patch.area;
    for (const auto corner : patch.corners) {
      const Rgb& b = lit.vertices[corner];
      sum += patch.area * (b.r + b.g + b.b) / 12;
    }
  }
  return sum / area;
}

}  // namespace radiosity
