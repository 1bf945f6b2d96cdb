#pragma once
// The options of tlab render for renderings that can be interrupted and resumed, and their
// execution.

#include "experiments/laboratory/picture/progressive_options.hpp"
#include "renderer/progressive/refinement.hpp"
#include "renderer/trace/render.hpp"

namespace laboratory {

/// Limits at which a rendering ends before it is complete.
struct Budget {
  /// share of all samples of the image, in percent, including the samples of earlier runs
  double percent = 100;
  std::optional<double> seconds;  ///< time limit for this run, host seconds
  bool is_spent(double after) const { return seconds && after >= *seconds; }
};

struct RefinedOptions {
  std::optional<renderer::progressive::Order> order;
  std::optional<Budget> budget;
  std::string state, resume;  ///< state files to write and to continue from; "": none

  /// True if the user gave one of these options.
  bool are_wanted() const { return order || budget || !state.empty() || !resume.empty(); }
};

/// Adds the options. They exclude the options of `command` that select another way of rendering.
void add_refined_options(CLI::App& command, RefinedOptions& options);

struct Refined {
  std::uint64_t done = 0, all = 0;  ///< numbers of samples: rendered so far, and of the whole image
  std::uint64_t rays = 0;           ///< number of rays traced in this run
  std::size_t queue_peak = 0;
  bool interrupted = false;
  renderer::Rendering image;  ///< the rendered image, which may be incomplete
};

/// Renders until the image is complete, the budget is spent, or an interrupt is counted by the
/// caller's InterruptGuard. Writes states, and also intermediate pictures if the task has a folder
/// for them.
Refined render_refined(const RefinedOptions& options, const RenderTask& task,
                       const renderer::Scene& scene);

/// Throws the exception that ends the program after an interrupt. To be called after the output is
/// written.
[[noreturn]] void report_interrupt(const RefinedOptions& options, const RenderTask& task,
                                   const Refined& refined);

}  // namespace laboratory
