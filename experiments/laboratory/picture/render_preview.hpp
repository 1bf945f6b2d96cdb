#pragma once
// The option --preview of tlab render.
#include <optional>
#include <string>

#include "renderer/preview/preview.hpp"

namespace CLI {
class App;
}

namespace laboratory {

/// Adds the option --preview, which sets `step` and excludes the options of `command` that have no
/// effect on previews. `step` must outlive `command`.
void add_preview_option(CLI::App& command, std::optional<renderer::PreviewStep>& step);

/// Writes the preview as a PNG image and, unless `stats` is "", the counts of work as JSON.
void save_preview(const std::string& scene, const renderer::Params& params,
                  renderer::PreviewStep step, const std::string& output, const std::string& stats);

}  // namespace laboratory
