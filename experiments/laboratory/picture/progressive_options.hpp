#pragma once
// The options of tlab render --progressive, and their execution.
#include <string>

#include "experiments/laboratory/picture/image_encoding.hpp"
#include "renderer/progressive/params.hpp"

namespace CLI {
class App;
}

namespace laboratory {

struct ProgressiveOptions {
  bool is_wanted = false, no_pyramid = false;
  renderer::progressive::Step last;
  int max_cell = 16;
  renderer::progressive::StepKind kind = renderer::progressive::StepKind::cells;
};

/// Input of all rendering commands. The parameters must have passed renderer::check().
struct RenderTask {
  std::string scene, output, stats;
  std::string key_images;  ///< folder for intermediate pictures; "": write none
  ImageEncoding encoding;
  renderer::Params params;
  int threads = 1;
};

/// Adds --progressive and the options that depend on it.
void add_progressive_options(CLI::App& command, ProgressiveOptions& options);

/// Renders in successive steps and saves the requested files. Takes the depth and the area of the
/// last step from the task.
void render_progressively(const ProgressiveOptions& options, const RenderTask& task);

}  // namespace laboratory
