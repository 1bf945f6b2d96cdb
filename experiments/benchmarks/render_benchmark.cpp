// Rays a second of the sequential renderer, against POV-Ray and Embree on the same scenes.
//
//   render_benchmark [FOLDER]     images, scenes and logs go there; by default into .
#include "experiments/benchmarks/peers.hpp"
#include "renderer/generators.hpp"

using namespace benchmarks;
using namespace renderer;

namespace {

constexpr int RUNS = 3, SIZE = 512;

Sample run_ours(const Scene& scene, const Params& params, Rendering& rendering) {
  return best_of(RUNS, [&] {
    const double cpu_s = time_of([&] { rendering = render(scene, params); });
    return Sample{rendering.rays.total(), cpu_s};
  });
}

// Every ray of the picture, in the order the renderer traces them.
std::vector<Ray> collect_rays(const Scene& scene, const Params& params) {
  std::vector<Ray> rays;
  Children stack;
  Work work;
  for (int y = 0; y < params.height; ++y)
    for (int x = 0; x < params.width; ++x)
      for (stack = {make_primary(scene, params, x, y)}; !stack.empty();) {
        const Ray ray = stack.back();
        stack.pop_back();
        rays.push_back(ray);
        if (const auto hit = intersect(scene, ray, params.traversal, work))
          make_children(scene, params, ray, *hit, stack, work);
      }
  return rays;
}

// The queries alone, without shading: what Embree is asked.
EmbreeRun run_queries(const Scene& scene, const std::vector<Ray>& rays) {
  EmbreeRun result;
  result.sample = best_of(RUNS, [&] {
    Work work;
    result.hits = 0;
    const double cpu_s = time_of([&] {
      for (const Ray& ray : rays)
        result.hits += intersect(scene, ray, Traversal::nearest, work).has_value() ? 1 : 0;
    });
    return Sample{rays.size(), cpu_s};
  });
  return result;
}

void print(const char* what, const Sample& sample, const Sample& ours, const std::string& note) {
  fmt::print("  {:30} {:9} {:7.3f} {:7.2f} {:7.2f}   {}\n", what, sample.count, sample.cpu_s,
             1e-6 * sample.rate(), ours.rate() / sample.rate(), note);
}

void compare(const std::string& name, int spheres, int depth, const std::string& folder,
             Ratios& ratios) {
  const Scene scene = make_spheres(spheres);
  Params params;
  params.width = params.height = SIZE;
  params.limits.depth = depth;
  params.feelers = Feelers::front;  // as POV-Ray
  params.sample = SamplePosition::center;
  Rendering rendering;

  fmt::print("{}: {} spheres and a floor, {} x {}, depth {}, feelers to lights in front\n", name,
             spheres, SIZE, SIZE, depth);
  fmt::print("  {:30} {:>9} {:>7} {:>7} {:>7}\n", "", "rays", "CPU s", "M/s", "tlab/it");
  params.traversal = Traversal::exhaustive;
  const Sample thesis = run_ours(scene, params, rendering);
  params.traversal = Traversal::nearest;
  const Sample ours = run_ours(scene, params, rendering);
  save_png(fmt::format("{}/{}-tlab.png", folder, name), rendering.samples);
  const RayCounts& r = rendering.rays;
  print("tlab, nearest", ours, ours, fmt::format("{} + {} shadow", r.total() - r.shadow, r.shadow));
  print("tlab, exhaustive", thesis, ours, "the thesis's walk: boxes never clipped");
  const PovrayRun pov = run_povray(scene, params, rendering.samples, folder, name, RUNS);
  print("POV-Ray 3.7", pov.sample, ours,
        fmt::format("{} + {} shadow; images {:.4f} of 255 apart, {:.3f} % by more than 8", pov.rays,
                    pov.shadow, pov.difference, 100 * pov.differing));

  const std::vector<Ray> rays = collect_rays(scene, params);
  const EmbreeRun queries = run_queries(scene, rays), embree = run_embree(scene, rays, RUNS);
  print("tlab, queries alone", queries.sample, ours, fmt::format("{} hits", queries.hits));
  print("Embree 3, queries alone", embree.sample, ours,
        fmt::format("{} hits; float; {:.2f} x our queries", embree.hits,
                    embree.sample.rate() / queries.sample.rate()));
  fmt::print("\n");
  ratios.add(name + ": rays/s, tlab / POV-Ray 3.7", ours.rate() / pov.sample.rate());
  ratios.add(name + ": rays/s, tlab exhaustive / POV-Ray 3.7", thesis.rate() / pov.sample.rate());
  ratios.add(name + ": queries/s, tlab / Embree 3", queries.sample.rate() / embree.sample.rate());
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string folder = argc > 1 ? argv[1] : ".";
  fmt::print("Rays a second of host CPU time, one thread, best of {}\n{}\n\n", RUNS, host());
  Ratios ratios;
  compare("spheres-800", 800, 15, folder, ratios);
  compare("balls-4", 7381, 5, folder, ratios);
  ratios.print();
} catch (const std::exception& failure) {
  fmt::print(stderr, "{}\n", failure.what());
  return 1;
}
