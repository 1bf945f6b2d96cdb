#pragma once
// The options of tlab render --frames, and their execution.
#include <string>

#include "experiments/laboratory/picture/progressive_options.hpp"

namespace laboratory {

struct FramesOptions {
  /// frames to render, "A-B", counted from 0; "": render a single image
  std::string frames;
  double rate = 25;           ///< frames per second
  bool is_confirmed = false;  ///< true: the user gave --yes, to render even if it takes long
};

/// Adds --frames and --frame-rate. Must be called after the options that --frames excludes were
/// added.
void add_frames_options(CLI::App& command, FramesOptions& options);

/// Renders an image of each frame. The output name of the task must end in .png, .exr or .webp.
/// Writes nothing if the scene cannot be read for some frame. Estimates the total time from the
/// first frame (see announce_cost() in host/progress.hpp).
void render_frames(const FramesOptions& options, const RenderTask& task);

}  // namespace laboratory
