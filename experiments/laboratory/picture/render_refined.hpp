#pragma once
// Resumable rendering of tlab render in an order of pixels: options and execution.

#include "experiments/laboratory/picture/progressive_options.hpp"
#include "renderer/progressive/refinement.hpp"
#include "renderer/trace/render.hpp"

namespace laboratory {

/// Limits that end a rendering early.
struct Budget {
  double percent = 100;           ///< of all samples, including those of earlier runs
  std::optional<double> seconds;  ///< of this run
};

struct RefinedOptions {
  std::optional<renderer::progressive::Order> order;
  std::optional<Budget> budget;
  std::string state, resume;  ///< files; "": none

  /// True if one of the options was given.
  bool are_wanted() const { return order || budget || !state.empty() || !resume.empty(); }
};

/// Adds the options, which exclude those of `command` for other ways of rendering.
void add_refined_options(CLI::App& command, RefinedOptions& options);

struct Refined {
  renderer::Rendering image;        ///< possibly incomplete
  std::uint64_t done = 0, all = 0;  ///< samples
  std::uint64_t rays = 0;           ///< of this run
  std::size_t queue_peak = 0;
  bool interrupted = false;
};

/// Renders until the end, the budget or an interrupt that the caller's InterruptGuard counts.
/// Writes states, and intermediate pictures if the task has a folder for them.
Refined render_refined(const RefinedOptions& options, const RenderTask& task,
                       const renderer::Scene& scene);

/// Throws the exception that ends the program after an interrupt, once the output is written.
[[noreturn]] void report_interrupt(const RefinedOptions& options, const RenderTask& task,
                                   const Refined& refined);

}  // namespace laboratory
