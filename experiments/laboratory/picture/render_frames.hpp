#pragma once
// tlab render --frames: options and execution.
#include <CLI/CLI.hpp>
#include <string>

#include "experiments/laboratory/picture/progressive_options.hpp"

namespace laboratory {

struct FramesOptions {
  std::string frames;  ///< "A-B"; "": one image
  double rate = 25;    ///< frames a second
};

/// Adds --frames and --frame-rate; the options that --frames excludes must exist.
void add_frames_options(CLI::App& command, FramesOptions& options);

/// Renders an image of every frame; the task's output is a name that ends in .png or .webp. Writes
/// nothing unless the scene is readable at all frames.
void render_frames(const FramesOptions& options, const RenderTask& task);

}  // namespace laboratory
