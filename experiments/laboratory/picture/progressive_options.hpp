#pragma once
// tlab render --progressive: options and body.
#include <CLI/CLI.hpp>
#include <string>

#include "renderer/progressive/params.hpp"

namespace laboratory {

struct ProgressiveOptions {
  bool is_wanted = false, no_pyramid = false;
  renderer::progressive::Step last;
  int max_cell = 16;
  renderer::progressive::Growth growth = renderer::progressive::Growth::cells;
};

/// What the ways of rendering are asked for; the parameters have passed renderer::check().
struct RenderTask {
  std::string scene, output, stats;
  std::string key_images;  ///< folder for pictures on the way; "": none
  renderer::Params params;
  int threads = 1;
};

/// Adds --progressive, and the options that need it.
void add_progressive_options(CLI::App& command, ProgressiveOptions& options);

/// Renders step by step and saves what is asked for. The step's depth and area are the task's.
void render_progressively(const ProgressiveOptions& options, const RenderTask& task);

}  // namespace laboratory
