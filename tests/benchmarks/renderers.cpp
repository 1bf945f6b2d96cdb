// Rays per second of the sequential renderer, compared with POV-Ray and Embree for the same scenes.
#include "tests/benchmarks/renderers.hpp"

#include <memory>

#include "base/random.hpp"
#include "renderer/scene/generators.hpp"
#include "tests/benchmarks/machine.hpp"

namespace benchmarks {

using namespace renderer;

namespace {

constexpr int SIZE = 512;

Params make_params(int depth) {
  Params params;
  params.width = params.height = SIZE;
  params.limits.depth = depth;
  params.feelers = Feelers::front;  // only to lights on the visible side, as in POV-Ray
  params.sample = SamplePosition::center;
  params.traversal = Traversal::nearest;
  return params;
}

// Collects all rays of the picture, in the order in which the renderer casts them.
std::vector<Ray> collect_rays(const Scene& scene, const Params& params) {
  std::vector<Ray> rays;
  Children stack;
  Work work;
  for (int y = 0; y < params.height; ++y)
    for (int x = 0; x < params.width; ++x)
      for (stack = {make_primary(scene.view, params, x, y)}; !stack.empty();) {
        const Ray ray = stack.back();
        stack.pop_back();
        rays.push_back(ray);
        if (const auto hit = intersect(scene, ray, params.traversal, work))
          make_children(scene, params, ray, *hit, stack, work);
      }
  return rays;
}

// A view of a scene, with its image and its rays. It is made when it is first used.
struct View {
  View(int spheres, int depth) : View(make_spheres(spheres), depth) {}
  View(Scene made, int depth)
      : scene(std::move(made)),
        params(make_params(depth)),
        samples(render(scene, params).samples),
        rays(collect_rays(scene, params)) {}
  const Scene scene;
  const Params params;
  const Samples samples;
  const std::vector<Ray> rays;
};
using GetView = std::function<const View&()>;

Sample run_ours(const View& view, Traversal traversal) {
  Params params = view.params;
  params.traversal = traversal;
  std::uint64_t rays = 0;
  const double cpu_s = time_of([&] { rays = render(view.scene, params).rays.total(); });
  return {rays, cpu_s};
}

// Makes spheres that move in random directions, by at most their diameter, while the shutter is
// open. With `stop`, they stand still halfway along their paths.
Scene make_moving_spheres(int spheres, bool stop) {
  Scene scene = make_spheres(spheres);
  scene.moves.resize(object_count(scene));
  std::uint64_t n = 0;
  const auto random = [&] {
    return static_cast<double>(base::random_at(1, n++) >> 11) * 0x1p-52 - 1;
  };
  for (const Sphere& s : scene.spheres)
    scene.moves[s.tag.object] = 2 * s.radius / std::sqrt(3.0) * Vec{random(), random(), random()};
  for (std::uint32_t i = 0; stop && i < object_count(scene); ++i)
    translate(scene, i, eval_shift(scene, i, 0.5));
  if (stop) scene.moves.clear();
  finish(scene);
  return scene;
}

// Only intersects the rays, without shading. Embree gets the same rays.
HitSample run_queries(const View& view) {
  HitSample result;
  Work work;
  const double cpu_s = time_of([&] {
    for (const Ray& ray : view.rays)
      result.hits += intersect(view.scene, ray, Traversal::nearest, work).has_value() ? 1 : 0;
  });
  result.sample = {view.rays.size(), cpu_s};
  return result;
}

void compare(const Samples& ours, const Samples& theirs, benchmark::State& state) {
  const auto a = make_rgb8(ours), b = make_rgb8(theirs);
  double sum = 0, differing = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const int apart = std::abs(a[i] - b[i]);
    sum += apart;
    differing += apart > 8 ? 1 : 0;
  }
  const auto count = static_cast<double>(a.size());
  state.counters["image_difference"] = sum / count;  // mean difference of colour values, 0 to 255
  // share of the colour values that differ by more than 8
  state.counters["image_differing"] = differing / count;
}

void add_view(const std::string& name, GetView view) {
  const std::string rays = "rays, " + name, queries = "queries, " + name;
  const auto ours = [view](Traversal traversal) {
    return [view, traversal](benchmark::State&) { return run_ours(view(), traversal); };
  };
  add(rays, "tlab", ours(Traversal::nearest));
  add(rays, "tlab exhaustive", ours(Traversal::exhaustive));
  add(rays, "povray", [view](benchmark::State& state) {
    const PovrayRun run = run_povray(view().scene, view().params, {}, temporary_folder());
    compare(view().samples, run.image, state);
    return run.sample;
  });
  const auto add_queries = [&](const char* who, std::function<HitSample(const View&)> run) {
    add(queries, who, [view, run](benchmark::State& state) {
      const HitSample result = run(view());
      state.counters["hits"] = static_cast<double>(result.hits);
      return result.sample;
    });
  };
  add_queries("tlab", run_queries);
  add_queries("embree", [](const View& v) { return run_embree(v.scene, v.rays); });
}

}  // namespace

void add_renderers() {
  for (const bool stop : {true, false})
    add("rays, 3200 spheres that move", stop ? "tlab, stopped" : "tlab", [stop](benchmark::State&) {
      static const View still(make_moving_spheres(3200, true), 5);
      static const View moving(make_moving_spheres(3200, false), 5);
      return run_ours(stop ? still : moving, Traversal::nearest);
    });
  add_view("800 spheres", []() -> const View& {
    static const View view(800, 15);
    return view;
  });
  add_view("7381 spheres", []() -> const View& {
    static const View view(7381, 5);
    return view;
  });
}

}  // namespace benchmarks
