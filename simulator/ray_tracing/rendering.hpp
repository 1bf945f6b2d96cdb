#pragma once
// Results of a run that all ray tracing programs have: pictures, columns, and results for reports.
#include "renderer/trace/render.hpp"
#include "simulator/ray_tracing/scene.hpp"
#include "simulator/snapshots/quality_curve.hpp"

namespace ray_tracing {

/// The picture as it was at the end of a stage, or when the user gave an order.
struct KeyImage {
  machine::Seconds at;
  std::string name;
  std::vector<std::uint8_t> rgb8;
};

struct Rendering {
  renderer::Samples samples;
  std::vector<std::uint8_t> rgb8;    ///< final picture on the display
  std::vector<KeyImage> key_images;  ///< at the end of each stage and at each order
  /// Pictures that snapshots::Recorder has recorded.
  std::vector<snapshots::Snapshot> pictures, growth;
  renderer::RayCounts rays;
  double time_s = 0;   ///< seconds from the first task until the last ray is displayed
  double setup_s = 0;  ///< seconds before the first task
  std::optional<double> order_to_pixel_s;  ///< longest time from an order until it changes a pixel
  bool is_aborted = false;                 ///< true if the user aborted the run
  observe::Use use;                        ///< use of the machine during these time_s seconds
  machine::ProcessId coordination = 0;     ///< id of the process that coordinates the others
  /// If not `done`, measurements describe the time up to this end.
  machine::End end = machine::End::done;
  std::uint64_t events = 0;                 ///< number of simulated events
  std::vector<observe::KernelUse> kernels;  ///< kernels called on any processor
  /// Sentences about orders without effect and about removed links.
  std::vector<std::string> notes;
};

/// Renders the final picture of every run with these parameters, with the sequential renderer.
/// Returns an empty list as soon as `goes_on` returns false.
std::vector<std::uint8_t> render_sequentially(const renderer::Scene& scene,
                                              const renderer::Params& params,
                                              const std::function<bool()>& goes_on);

// The next functions return groups of columns that all programs share.

/// The columns time_s and time_per_ray_ms, and columns for the speed-up. Speed-up columns are empty
/// here, because they depend on other runs of the sweep.
base::Columns<Rendering> speed_columns();
/// The column "rays", and one column for each kind of ray.
base::Columns<Rendering> ray_columns();
/// The columns order_to_pixel_s, setup_s and total_s.
base::Columns<Rendering> time_columns();
/// Columns for the end of each stage, and for the fraction of lit pixels in the picture at this
/// end. Also the column aborted.
base::Columns<Rendering> stage_columns();

/// The picture's quality over time, and all other results of a run that are not in its rows.
struct Given {
  programs::Extras extras;    ///< without the loads, and without the results of Setup::profile
  snapshots::Figures growth;  ///< empty if quality over time was not recorded
};
/// Collects the results of a run besides its rows. The images are the final picture, key
/// images (pictures at the end of each stage and at each order of the user), pictures at the
/// requested times, and an animation of the growing picture. `max_cell` is the side of the largest
/// image cells in pixels.
Given make_given(const programs::Setup& setup, const SceneChoice& scene,
                 const renderer::Params& image, int max_cell, const Rendering& rendering);

}  // namespace ray_tracing
