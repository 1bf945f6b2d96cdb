#pragma once
// Declares and parses the options that several commands share.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "base/fields.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "renderer/trace/render.hpp"

namespace laboratory {

/// Throws CLI::ValidationError "option: message" unless `holds` is true.
template <class... Args>
void require_option(bool holds, const std::string& option, fmt::format_string<Args...> message,
                    Args&&... args) {
  if (!holds) throw CLI::ValidationError(option, fmt::format(message, std::forward<Args>(args)...));
}

/// Adds the options --output, --set and --jobs. `output` and `set` are the help texts of --output
/// and --set.
void add_run_options(CLI::App& command, RunOptions& options, const std::string& output,
                     const std::string& set);

/// A check for every option that takes the name of a file, or of a folder: returns a message for an
/// empty name, else "".
std::string check_file_name(const std::string& name);
std::string check_folder_name(const std::string& name);

/// Makes a check for an option whose values are those of the domain. Returns "found ..., expected
/// ..." for another value.
std::function<std::string(const std::string&)> check_value(const base::Domain& domain);

/// Adds an option that takes names separated by commas, and may be repeated. `take` receives all
/// names. Throws CLI::ValidationError for an empty name.
CLI::Option* add_names_option(CLI::App& app, const std::string& option,
                              const std::function<void(std::vector<std::string>)>& take,
                              const std::string& help);

/// Adds the option --set, which appends to `overrides`.
void add_set_option(CLI::App& command, Overrides& overrides, const std::string& help);

/// Adds --width, --font and --font-size, which set the keys of a figure.
void add_figure_options(CLI::App& command, FigureSpec& figure);

/// Options whose names differ from those of their fields: field to option, without "--".
using Aliases = std::map<std::string, std::string>;

/// Adds the option `--name`. `assign` receives its value, and returns "" if the value is valid, or
/// else a description of the valid values. The help shows `standard` as the default value.
CLI::Option* add_field_option(CLI::App& app, const std::string& name, const std::string& help,
                              const base::Domain& domain, const base::Scalar& standard,
                              const std::function<std::string(const base::Scalar&)>& assign);

/// Adds the option `--name`, which overrides the key `key` of the experiment file. The option has
/// the valid values and the default of this key.
CLI::Option* add_key_option(CLI::App& app, const std::string& name, const std::string& key,
                            Overrides& overrides, const std::string& help);

/// Adds an option for each field. It has the field's name, with - for _, unless `aliases` gives
/// another. The option sets the field in `params`, which must outlive `app`. The default is the
/// field's current value. Fields must be numbers, choices or strings.
template <class P>
void bind_options(CLI::App& app, const base::Fields<P>& fields, P& params,
                  const Aliases& aliases = {}) {
  for (const auto& field : fields) {
    const auto alias = aliases.find(field.name);
    const auto help = field.unit.empty() ? field.help : field.help + "; " + field.unit;
    add_field_option(app, alias != aliases.end() ? alias->second : field.name, help, field.domain,
                     field.get(params), [field, &params](const base::Scalar& value) {
                       return field.assign(params, value);
                     });
  }
}

/// Converts counts of work and of rays to JSON, for the file of --stats.
nlohmann::ordered_json make_json(const renderer::Work& work);
nlohmann::ordered_json make_json(const renderer::RayCounts& rays);

/// Checks the image name `output` and the file name `stats`. Throws CLI::ValidationError if the
/// image has an extension that is not among `endings` (such as ".png"), if a folder is missing, or
/// if both names denote the same file. An image name without an extension is valid.
void check_output(const std::string& output, const std::vector<std::string>& endings,
                  const std::string& stats);
/// Throws if `file`, the value of `option`, is the same file as one of `others`. Empty names match
/// nothing.
void check_apart(const std::string& option, const std::string& file,
                 std::initializer_list<std::string> others);

/// Throws the error of base::check_can_save() for the first of the files that cannot be written. To
/// be called after all input is read and before long work. Skips empty names.
void check_can_save_all(std::initializer_list<std::string> files);

/// Help of --columns in commands that show the results of a run.
inline constexpr const char* COLUMNS_HELP =
    "results that the table shows beside the axes, or all [those used in the file, and others that "
    "fit]";

/// Makes the folder that is the value of `option`, unless it exists. Throws CLI::ValidationError if
/// that fails.
void make_folder(const std::string& option, const std::string& path);

/// Parses the size "WxH" (N = 2) or the area "X,Y,WxH" (N = 4). Throws CLI::ValidationError for
/// other text; the message describes the expected `form`.
template <std::size_t N>
std::array<int, N> parse_numbers(const std::string& option, const std::string& text,
                                 const char* form) {
  std::array<int, N> values{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < N; ++i) {
    const auto [next, error] = std::from_chars(at, end, values[i]);
    const char separator = i + 2 == N ? 'x' : ',';
    const bool more = i + 1 < N;
    require_option(error == std::errc{} && (more ? next != end && *next == separator : next == end),
                   option, "found \"{}\", expected {}", text, form);
    at = next + 1;
  }
  return values;
}

/// Sets `params.width` and `params.height` from the value of --size, unless it is empty.
template <class Params>
void parse_size(const std::string& text, Params& params) {
  if (text.empty()) return;
  const auto v = parse_numbers<2>("--size", text, "WxH, such as 512x512");
  require_option(v[0] >= 1 && v[1] >= 1, "--size",
                 "found {} x {}, expected 1 to 65536 pixels on each side", v[0], v[1]);
  params.width = v[0];
  params.height = v[1];
}

}  // namespace laboratory
