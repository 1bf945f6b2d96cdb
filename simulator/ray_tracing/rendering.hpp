#pragma once
// Results of a run of any ray tracing program: pictures, columns, extras.
#include "renderer/trace/render.hpp"
#include "simulator/ray_tracing/scene.hpp"
#include "simulator/snapshots/quality_curve.hpp"

namespace ray_tracing {

/// The picture at the time when the limits of a stage were reached, or at an order of the user.
struct KeyImage {
  machine::Seconds at;
  std::string name;
  std::vector<std::uint8_t> rgb8;
};

struct Rendering {
  renderer::Samples samples;
  std::vector<std::uint8_t> rgb8;                     ///< the display's picture
  std::vector<KeyImage> key_images;                   ///< at the ends of stages and at orders
  std::vector<snapshots::Snapshot> pictures, growth;  ///< see snapshots::Recorder
  renderer::RayCounts rays;
  double time_s = 0;                        ///< from the first task to the last ray shown complete
  double setup_s = 0;                       ///< before it: send scene, deposit initial rays
  std::optional<double> order_to_pixel_s;   ///< longest time from an order to a changed pixel
  bool is_aborted = false;                  ///< by the user
  observe::Use use;                         ///< loads over time_s
  machine::End end = machine::End::done;    ///< if not done: all is measured up to this end
  std::uint64_t events = 0;                 ///< number of simulated events
  std::vector<observe::KernelUse> kernels;  ///< called kernels, over all processors
  std::vector<std::string> notes;           ///< on orders without an effect, on a link given up
};

/// The final picture of every run, by the sequential renderer; empty if `goes_on` returns false.
std::vector<std::uint8_t> render_sequentially(const renderer::Scene& scene,
                                              const renderer::Params& params,
                                              const std::function<bool()>& goes_on);

// Groups of columns common to all programs.

/// time_s, time_per_ray_ms, and the columns of the speed-up; these are empty and need other runs.
base::Columns<Rendering> speed_columns();
/// rays, and one column for each kind of ray.
base::Columns<Rendering> ray_columns();
/// order_to_pixel_s, setup_s and total_s.
base::Columns<Rendering> time_columns();
/// End of each stage and lit share of its key image; aborted.
base::Columns<Rendering> stage_columns();

/// Results of a run beside its rows, and the figures of its picture's growth.
struct Given {
  programs::Extras extras;    ///< all but the loads and the results of Setup::profile
  snapshots::Figures growth;  ///< empty if growth was not recorded
};
/// `max_cell`: side of the largest cells of the growing picture, pixels. Images: the last picture,
/// key images, pictures at the requested times, and the growth as an animation.
Given make_given(const programs::Setup& setup, const SceneChoice& scene,
                 const renderer::Params& image, int max_cell, const Rendering& rendering);

}  // namespace ray_tracing
