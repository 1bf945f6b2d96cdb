#pragma once
// The options of tlab render for resumable rendering in an order of pixels, and their execution.

#include "experiments/laboratory/picture/progressive_options.hpp"
#include "renderer/progressive/refinement.hpp"
#include "renderer/trace/render.hpp"

namespace laboratory {

/// Limits that end a rendering early.
struct Budget {
  double percent = 100;           ///< share of all samples, including those of earlier runs
  std::optional<double> seconds;  ///< time limit for this run
};

struct RefinedOptions {
  std::optional<renderer::progressive::Order> order;
  std::optional<Budget> budget;
  std::string state, resume;  ///< state files to write and to continue from; "": none

  /// True if the user gave any option of a refined rendering.
  bool are_wanted() const { return order || budget || !state.empty() || !resume.empty(); }
};

/// Adds the options. They exclude the options of `command` for other ways of rendering.
void add_refined_options(CLI::App& command, RefinedOptions& options);

struct Refined {
  renderer::Rendering image;        ///< the rendered image, perhaps incomplete
  std::uint64_t done = 0, all = 0;  ///< number of samples rendered, and of the whole image
  std::uint64_t rays = 0;           ///< number of rays traced in this run
  std::size_t queue_peak = 0;
  bool interrupted = false;
};

/// Renders up to the end, the budget, or an interrupt that the caller's InterruptGuard counts.
/// Writes states, and also intermediate pictures if the task has a folder for them.
Refined render_refined(const RefinedOptions& options, const RenderTask& task,
                       const renderer::Scene& scene);

/// Throws the exception that ends the program after an interrupt. Called once the output is
/// written.
[[noreturn]] void report_interrupt(const RefinedOptions& options, const RenderTask& task,
                                   const Refined& refined);

}  // namespace laboratory
