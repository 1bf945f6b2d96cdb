// Text of the model files that tlab writes.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/text.hpp"
#include "experiments/laboratory/calibrate/calibration.hpp"
#include "experiments/laboratory/file/values.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {
namespace {

// Splits "link.one_way_20" into its section and its key.
std::pair<std::string, std::string> split_key(const std::string& key) {
  const auto dot = key.find('.');
  return {key.substr(0, dot), key.substr(dot + 1)};
}

// Spells the base model's path relative to the folder of the new model file.
std::string name_base(const std::string& base, const std::string& file) {
  if (!base.ends_with(".toml")) return base;
  namespace fs = std::filesystem;
  return fs::relative(fs::absolute(base), fs::absolute(file).parent_path()).string();
}

// The end of the first line of every fitted model file, by which is_fitted_model() recognises it.
constexpr std::string_view IS_FITTED =
    ", with entries fitted to measurements (tlab model --fit). The root mean square error is\n";

// Replaces control characters by blanks, so that the text fits into a one-line comment.
std::string plain(const std::string& text) { return base::blank_controls(text, '?'); }

}  // namespace

std::string to_model_file(const Calibration& calibration, const CalibrationTask& task,
                          const std::string& file) {
  const auto name = std::filesystem::path(file).stem().string();
  const auto source =
      fmt::format("fitted to {} measurements of {} in {}", calibration.compared.rows.size(),
                  calibration.column, task.measurements);
  std::string text =
      fmt::format("# {}{}# {:.2g} %.\nname = {}\nbase = {}\n", plain(task.model), IS_FITTED,
                  100 * calibration.rms, spell_text(name), spell_text(name_base(task.model, file)));
  std::string section;
  auto entries = calibration.entries;
  std::ranges::stable_sort(entries, {}, [](const auto& e) { return split_key(e.key).first; });
  for (const auto& e : entries) {
    const auto [its, entry] = split_key(e.key);
    if (its != section) text += fmt::format("\n[{}]\n", section = its);
    text += fmt::format(
        "{} = {{ value = {}, unit = {}, provenance = \"calibrated\", source = {}, low = {}, high = "
        "{}, why = \"95 % confidence interval of the fit\" }}\n",
        entry, e.value, spell_text(e.unit), spell_text(source), e.low, e.high);
  }
  return text;
}

bool is_fitted_model(std::string_view text) {
  return text.substr(0, text.find('\n') + 1).ends_with(IS_FITTED);
}

std::string make_model_file(const std::string& base, const std::string& file) {
  const auto name = std::filesystem::path(file).stem().string();
  const auto model = machine::load_model(base);
  std::string text = fmt::format(
      "# A machine like {0}, except for the entries below. To change an entry, remove the # "
      "before\n"
      "# it and before the [section] above it. Each entry has\n"
      "#   value       a number, or in quotes a formula over other entries: \"2 * "
      "link.switch_bits\"\n"
      "#   unit        leave it unchanged\n"
      "#   provenance  datasheet, thesis, calibrated or assumed\n"
      "#   source      where the value is from, so that others can find it\n"
      "# and, if its value is uncertain, low, high and why: the range for tlab run --uncertain.\n"
      "#     tlab model {1}              # every number\n"
      "#     tlab model {1} {0}      # the differences\n"
      "# In an experiment: machine.model = \"{1}\"\n"
      "name = {2}\nbase = {3}\n",
      plain(base), plain(file), spell_text(name), spell_text(name_base(base, file)));
  std::string section;
  for (const auto& entry : model.entries) {
    const auto [its, last] = split_key(entry.key);
    if (its != section) text += fmt::format("\n# [{}]\n", section = its);
    text += fmt::format(
        "# {} = {{ value = {}, unit = {}, provenance = \"{}\", source = {} }}\n", last,
        entry.formula.empty() ? fmt::format("{}", entry.value) : spell_text(entry.formula),
        spell_text(entry.unit), machine::to_string(entry.provenance), spell_text(entry.source));
  }
  return text;
}

}  // namespace laboratory
