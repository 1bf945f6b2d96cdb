#pragma once
// What a run of any program that traces rays shows and measures: pictures, columns, extras.
#include "renderer/trace/render.hpp"
#include "simulator/growth/growth.hpp"
#include "simulator/tracing/scene.hpp"

namespace tracing {

/// The picture as it was when the limits of a stage were reached, or at an order of the user's.
struct KeyImage {
  machine::Seconds at;
  std::string name;
  std::vector<std::uint8_t> rgb8;
};

struct Rendering {
  renderer::Samples samples;
  std::vector<std::uint8_t> rgb8;               ///< the display's picture
  std::vector<KeyImage> key_images;             ///< at the end of a stage, at an order
  std::vector<growth::Shown> pictures, growth;  ///< see growth::Recorder
  renderer::RayCounts rays;
  double time_s = 0;                        ///< from the first task to the last ray shown complete
  double setup_s = 0;                       ///< before: scene sent, initial rays deposited
  std::optional<double> order_to_pixel_s;   ///< the longest from an order to a pixel it changed
  bool is_aborted = false;                  ///< by the user
  observe::Use use;                         ///< what was busy over time_s
  machine::End end = machine::End::done;    ///< else all this is what was measured until then
  std::uint64_t events = 0;                 ///< simulated
  std::vector<observe::KernelUse> kernels;  ///< of all processors, those that were called
  std::vector<std::string> notes;           ///< on orders without an effect, on a link given up
};

/// What every run shows in the end, by the sequential renderer; empty if `goes_on` returns false.
std::vector<std::uint8_t> render_sequentially(const renderer::Scene& scene,
                                              const renderer::Params& params,
                                              const std::function<bool()>& goes_on);

// The columns that every program has, in groups.

/// time_s, time_per_ray_ms, and those of the speed-up, which are empty, since it needs other runs.
base::Columns<Rendering> speed_columns();
/// rays, and of each kind.
base::Columns<Rendering> ray_columns();
/// order_to_pixel_s, setup_s and total_s.
base::Columns<Rendering> time_columns();
/// When each stage ended, and how much of its key image is lit; aborted.
base::Columns<Rendering> stage_columns();

/// What a run gives beside its rows, and the figures of how its picture grew.
struct Given {
  programs::Extras extras;  ///< all but the loads and Setup::profile's
  growth::Figures growth;   ///< empty where that was not looked at
};
/// `max_cell`: side of the largest cells of a picture that grows, pixels. The images: the last
/// picture, key images, those that were to be shown, and how it grew as a moving picture.
Given make_given(const programs::Setup& setup, const SceneChoice& scene,
                 const renderer::Params& image, int max_cell, const Rendering& rendering);

}  // namespace tracing
