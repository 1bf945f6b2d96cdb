#include "experiments/laboratory/picture/render_preview.hpp"

#include <fmt/ranges.h>

#include "base/whole_file.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/options/options.hpp"
#include "experiments/laboratory/setup/open_scene.hpp"

namespace laboratory {

void add_preview_option(CLI::App& command, std::optional<renderer::PreviewStep>& step) {
  std::vector<std::string> names;
  for (const auto& [name, ignored] : renderer::preview_steps()) names.push_back(name);
  const auto set = [&step, names](const std::string& text) {
    for (const auto& [name, value] : renderer::preview_steps())
      if (name == text) step = value;
    require_option(step.has_value(), "--preview", "found {}, expected one of {}", text,
                   fmt::join(names, ", "));
  };
  auto* option = command.add_option_function<std::string>(
      "--preview", set, "fast picture by z-buffer instead of rays, with increasing detail");
  option->option_text(fmt::format("{}", fmt::join(names, "|")));
  for (const char* name : {"--depth", "--influence", "--threads", "--progressive"})
    option->excludes(command.get_option(name));
}

void save_preview(const RenderTask& task, renderer::PreviewStep step) {
  const auto scene = open_scene(task.scene);
  check_can_save_all({task.output, task.stats});
  Clock clock;
  const auto preview = renderer::make_preview(scene, task.params, step);
  const double seconds = clock.lap();
  save_image(task.output, preview.samples, task.encoding);
  if (task.stats.empty()) return;
  const auto& counts = preview.counts;
  const nlohmann::ordered_json text = {{"scene", task.scene},
                                       {"width", task.params.width},
                                       {"height", task.params.height},
                                       {"preview",
                                        {{"vertices", counts.vertices},
                                         {"facets", counts.facets},
                                         {"pixels_tested", counts.pixels_tested},
                                         {"pixels_drawn", counts.pixels_drawn}}},
                                       {"work", make_json(preview.work)},
                                       {"seconds", seconds}};
  base::save_whole(task.stats, text.dump(2) + "\n");
}

}  // namespace laboratory
