#pragma once
// Results of a run, common to all ray tracing programs: pictures, columns and extras.
#include "renderer/trace/render.hpp"
#include "simulator/ray_tracing/scene.hpp"
#include "simulator/snapshots/quality_curve.hpp"

namespace ray_tracing {

/// The picture at the end of a stage, or at an order of the user.
struct KeyImage {
  machine::Seconds at;
  std::string name;
  std::vector<std::uint8_t> rgb8;
};

struct Rendering {
  renderer::Samples samples;
  std::vector<std::uint8_t> rgb8;                     ///< final picture of the display
  std::vector<KeyImage> key_images;                   ///< at the ends of stages and at orders
  std::vector<snapshots::Snapshot> pictures, growth;  ///< see snapshots::Recorder
  renderer::RayCounts rays;
  double time_s = 0;                        ///< from the first task to the last ray displayed
  double setup_s = 0;                       ///< time before the first task
  std::optional<double> order_to_pixel_s;   ///< longest time from an order to a changed pixel
  bool is_aborted = false;                  ///< true if the user aborted the run
  observe::Use use;                         ///< use of the machine during time_s
  machine::ProcessId coordination = 0;      ///< the process that coordinates the others
  machine::End end = machine::End::done;    ///< if not `done`, measurements end there
  std::uint64_t events = 0;                 ///< number of simulated events
  std::vector<observe::KernelUse> kernels;  ///< kernels called on any processor
  std::vector<std::string> notes;           ///< orders without effect, removed links
};

/// Renders, with the sequential renderer, the picture that every run of these parameters ends with.
/// Returns an empty list if `goes_on` returns false.
std::vector<std::uint8_t> render_sequentially(const renderer::Scene& scene,
                                              const renderer::Params& params,
                                              const std::function<bool()>& goes_on);

// Groups of columns that all programs share.

/// The columns time_s and time_per_ray_ms, and columns for the speed-up. The latter are empty,
/// because they depend on other runs.
base::Columns<Rendering> speed_columns();
/// The column "rays", and one column for each kind of ray.
base::Columns<Rendering> ray_columns();
/// The columns order_to_pixel_s, setup_s and total_s.
base::Columns<Rendering> time_columns();
/// Columns for the end of each stage and for the lit fraction of its key image, and the column
/// aborted.
base::Columns<Rendering> stage_columns();

/// Results of a run besides its rows, and quality over time.
struct Given {
  programs::Extras extras;    ///< without loads and results of Setup::profile
  snapshots::Figures growth;  ///< empty if growth was not recorded
};
/// Collects the results. Images are the final picture, key images, pictures at the requested times,
/// and the growth as an animation. `max_cell` is the side of the largest cells in pixels.
Given make_given(const programs::Setup& setup, const SceneChoice& scene,
                 const renderer::Params& image, int max_cell, const Rendering& rendering);

}  // namespace ray_tracing
