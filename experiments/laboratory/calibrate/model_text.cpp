// Model files that tlab writes.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "experiments/laboratory/calibrate/calibration.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {
namespace {

// "[link]" and "one_way_20".
std::pair<std::string, std::string> split_key(const std::string& key) {
  const auto dot = key.find('.');
  return {key.substr(0, dot), key.substr(dot + 1)};
}

std::string quote(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

std::string to_model_file(const Calibration& calibration, const CalibrationTask& task,
                          const std::string& name) {
  const auto source =
      fmt::format("fitted to {} measurements of {} in {}", calibration.compared.rows.size(),
                  calibration.column, task.measurements);
  std::string text = fmt::format(
      "# {}, with what was fitted to measurements (tlab model --fit): they are met within {:.2g} "
      "%,\n"
      "# root mean square.\nname = {}\nbase = {}\n",
      task.model, 100 * calibration.rms, quote(name), quote(task.model));
  std::string section;
  auto entries = calibration.entries;
  std::ranges::stable_sort(entries, {}, [](const auto& e) { return split_key(e.key).first; });
  for (const auto& e : entries) {
    const auto [its, entry] = split_key(e.key);
    if (its != section) text += fmt::format("\n[{}]\n", section = its);
    text += fmt::format(
        "{} = {{ value = {}, unit = {}, provenance = \"calibrated\", source = {}, low = {}, high = "
        "{}, "
        "why = \"the 95 % interval of the fit\" }}\n",
        entry, e.value, quote(e.unit), quote(source), e.low, e.high);
  }
  return text;
}

std::string make_model_file(const std::string& base, const std::string& name) {
  const auto model = machine::load_model(base);
  std::string text = fmt::format(
      "# A machine like {0}, but for what is said here. Take the # from a line that you know "
      "better,\n"
      "# and from the [section] above it. Each entry has\n"
      "#   value       a number, or in quotes a formula over other entries: \"2 * "
      "link.switch_bits\"\n"
      "#   unit        as it stands\n"
      "#   provenance  datasheet, thesis, calibrated or assumed\n"
      "#   source      where the value is from, so that others find it\n"
      "# and where it is not known better low, high and why, from which tlab run --uncertain "
      "draws.\n"
      "#     tlab model {1}.toml              # every number\n"
      "#     tlab model {1}.toml {0}      # what differs\n"
      "# In an experiment: machine.model = \"{1}.toml\"\n"
      "name = {2}\nbase = {3}\n",
      base, name, quote(name), quote(base));
  std::string section;
  for (const auto& entry : model.entries) {
    const auto [its, last] = split_key(entry.key);
    if (its != section) text += fmt::format("\n# [{}]\n", section = its);
    text +=
        fmt::format("# {} = {{ value = {}, unit = {}, provenance = \"{}\", source = {} }}\n", last,
                    entry.formula.empty() ? fmt::format("{}", entry.value) : quote(entry.formula),
                    quote(entry.unit), machine::to_string(entry.provenance), quote(entry.source));
  }
  return text;
}

}  // namespace laboratory
