#pragma once
// tlab render in an order of pixels, that may be stopped and gone on with: options and body.

#include "experiments/laboratory/picture/progressive_options.hpp"
#include "renderer/progressive/refinement.hpp"
#include "renderer/trace/render.hpp"

namespace laboratory {

/// Where a rendering ends before it is done.
struct Budget {
  double percent = 100;           ///< of all samples, those of runs before included
  std::optional<double> seconds;  ///< of this run
};

struct RefinedOptions {
  std::optional<renderer::progressive::Order> order;
  std::optional<Budget> budget;
  std::string state, resume;  ///< files; "": none

  /// Whether one of the options was given.
  bool are_wanted() const { return order || budget || !state.empty() || !resume.empty(); }
};

/// Adds the options, which refuse those of `command` that render in another way.
void add_refined_options(CLI::App& command, RefinedOptions& options);

struct Refined {
  renderer::Rendering image;        ///< as far as it is
  std::uint64_t done = 0, all = 0;  ///< samples
  std::uint64_t rays = 0;           ///< of this run
  std::size_t queue_peak = 0;
  bool interrupted = false;
};

/// Renders until the end, the budget or an interrupt that an InterruptGuard of the caller counts,
/// and writes states, and pictures of its growth if the task has a folder for them.
Refined render_refined(const RefinedOptions& options, const RenderTask& task,
                       const renderer::Scene& scene);

/// Throws what ends the program after an interrupt, when what there is has been written.
[[noreturn]] void report_interrupt(const RefinedOptions& options, const RenderTask& task,
                                   const Refined& refined);

}  // namespace laboratory
