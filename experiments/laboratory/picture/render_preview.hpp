#pragma once
// The option --preview of tlab render.
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "renderer/preview/preview.hpp"

namespace laboratory {

/// Adds the option, which refuses those of `command` that have no effect on previews; it sets
/// `step`, which must outlive `command`.
void add_preview_option(CLI::App& command, std::optional<renderer::PreviewStep>& step);

/// Writes the PNG image, and unless `stats` is "" what was done.
void save_preview(const std::string& scene, const renderer::Params& params,
                  renderer::PreviewStep step, const std::string& output, const std::string& stats);

}  // namespace laboratory
