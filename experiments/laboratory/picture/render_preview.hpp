#pragma once
// The option --preview of tlab render.
#include <optional>
#include <string>

#include "experiments/laboratory/picture/progressive_options.hpp"
#include "renderer/preview/preview.hpp"

namespace laboratory {

/// Adds the option --preview, which sets `step` and excludes the options of `command` that have no
/// effect on previews. `step` must outlive `command`.
void add_preview_option(CLI::App& command, std::optional<renderer::PreviewStep>& step);

/// Writes the preview and, unless `stats` is "", the counts of work as JSON.
void save_preview(const RenderTask& task, renderer::PreviewStep step);

}  // namespace laboratory
