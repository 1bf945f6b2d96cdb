#pragma once
// The options of tlab render --frames, and their execution.
#include <string>

#include "experiments/laboratory/picture/progressive_options.hpp"

namespace laboratory {

struct FramesOptions {
  std::string frames;         ///< range "A-B"; "": render a single image
  double rate = 25;           ///< frames per second
  bool is_confirmed = false;  ///< --yes: render even if it takes long
};

/// Adds --frames and --frame-rate. The options that --frames excludes must already exist.
void add_frames_options(CLI::App& command, FramesOptions& options);

/// Renders an image of every frame. The output name of the task must end in .png or .webp. Writes
/// nothing unless the scene is readable at all frames. Estimates the duration from the first frame
/// (announce_cost in host/progress.hpp).
void render_frames(const FramesOptions& options, const RenderTask& task);

}  // namespace laboratory
