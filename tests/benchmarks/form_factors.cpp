// Rays per second in the calculation of form factors. The room has 14,000 patches and resembles
// that of figure 3.8: a window in a wall, with a polygon in front of it. The goal is 3 million rays
// per second on one core.
#include "renderer/radiosity/light/solve.hpp"
#include "tests/benchmarks/machine.hpp"
#include "tests/benchmarks/renderers.hpp"

namespace benchmarks {

using namespace radiosity;

namespace {

constexpr int SHOTS = 100;

Room make_room() {
  constexpr int N = 48, THIRD = N / 3;  // number of patches along a wall
  Room room;
  room.materials = {{"wall", {0.7, 0.7, 0.6}, {}},
                    {"window", {0, 0, 0}, {10, 10, 12}},
                    {"hanging", {0.4, 0.2, 0.2}, {}}};
  const auto add = [&](std::uint32_t material, Vec p, Vec a, Vec b, int along, int across) {
    Face face;
    face.corners = {p, p + a, p + a + b, p + b};
    face.material = material;
    face.along = along;
    face.across = across;
    room.faces.push_back(face);
  };
  constexpr Vec O{0, 0, 0}, X{4, 0, 0}, Y{0, 3, 0}, Z{0, 0, 2.5}, y{0, 1, 0}, z{0, 0, 1};
  add(0, O, X, Y, N, N);
  add(0, Z, Y, X, N, N);
  add(0, X, Z, Y, N, N);
  add(0, O, Z, X, N, N);
  add(0, Y, X, Z, N, N);
  add(0, O, y, Z, THIRD, N);
  add(0, y, y, z, THIRD, THIRD);
  add(1, y + z, y, z, THIRD, THIRD);
  add(0, y + 2 * z, y, 0.5 * z, THIRD, THIRD);
  add(0, 2 * y, y, Z, THIRD, N);
  add(2, {1.5, 1.2, 1.2}, 0.6 * y, 0.6 * z, N / 4, N / 4);
  room.faces.back().two_sided = true;
  return room;
}

// Collects the rays of the first patches that shoot light, as the kernel casts them if each patch
// is a single delta area.
std::vector<renderer::Ray> collect_rays(const Mesh& mesh, int shots) {
  std::vector<renderer::Ray> rays;
  for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
    const Patch& from = mesh.patches[i];
    if (mesh.materials[from.material].name != "window" || shots-- <= 0) continue;
    for (const Vertex& to : mesh.vertices) {
      const Vec way = from.centre - to.lit;
      if (dot(way, to.normal) <= 0 || dot(way, from.normal) >= 0) continue;
      renderer::Ray ray;
      ray.origin = to.lit;
      ray.direction = normalize(way);
      // lets the ray end before it reaches the patch, even in single precision
      ray.reach = length(way) * (1 - 1e-4);
      ray.from = to.object;
      ray.kind = renderer::RayKind::shadow;
      rays.push_back(ray);
    }
  }
  return rays;
}

const Mesh& mesh() {
  static const Mesh made = make_mesh(make_room(), {});
  return made;
}
const std::vector<renderer::Ray>& rays() {
  static const auto made = collect_rays(mesh(), SHOTS);
  return made;
}

Sample run_shots(benchmark::State& state) {
  SolveParams params;
  params.shots = SHOTS;
  params.tolerance = 0;
  mesh();
  renderer::Work work;
  const double cpu_s = time_of([&] { work = solve(mesh(), params).work; });
  state.counters["patches"] = static_cast<double>(mesh().patches.size());
  return {work[renderer::Op::ray_intersected], cpu_s};
}

HitSample run_queries() {
  HitSample result;
  renderer::Work work;
  const double cpu_s = time_of([&] {
    for (const auto& ray : rays())
      result.hits +=
          intersect(mesh().blockers, ray, renderer::Traversal::nearest, work).has_value() ? 1 : 0;
  });
  result.sample = {rays().size(), cpu_s};
  return result;
}

}  // namespace

void add_form_factors() {
  // compares the whole calculation of form factors with the casting of its rays alone
  const std::string what = "form-factor rays, 14,000 patches";
  const auto add_queries = [&](const char* who, std::function<HitSample()> run) {
    add(what, who, [run](benchmark::State& state) {
      rays();
      const HitSample result = run();
      state.counters["hits"] = static_cast<double>(result.hits);
      return result.sample;
    });
  };
  add(what, "tlab", run_shots);
  add_queries("tlab rays alone", run_queries);
  add_queries("embree", [] { return run_embree(mesh().blockers, rays()); });
}

}  // namespace benchmarks
