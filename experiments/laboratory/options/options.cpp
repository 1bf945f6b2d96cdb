#include "experiments/laboratory/options/options.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "base/text.hpp"
#include "base/whole_file.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;
using DomainKind = base::Domain::Kind;

base::Scalar parse_scalar(const std::string& text, DomainKind kind) {
  if (kind == DomainKind::flag && (text == "true" || text == "false")) return text == "true";
  if (kind == DomainKind::flag || kind == DomainKind::whole || kind == DomainKind::number) {
    if (const auto whole = base::parse_number<std::int64_t>(text)) return *whole;
    if (const auto number = base::parse_number<double>(text)) return *number;
  }
  return text;
}

std::string describe(const base::Domain& domain) {
  if (domain.kind == DomainKind::choice) return fmt::format("{}", fmt::join(domain.choices, "|"));
  if (domain.kind == DomainKind::flag) return "true|false";
  if (domain.high == std::numeric_limits<double>::max()) return "NUMBER";
  return domain.kind == DomainKind::text ? "TEXT" : fmt::format("{}..{}", domain.low, domain.high);
}

fs::path whole_path(const std::string& path) {
  std::error_code ignored;
  // absolute() is needed, since weakly_canonical() leaves a relative path relative if no part of it
  // exists
  return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
}

void check_folder(const std::string& option, const std::string& path) {
  const auto folder = fs::path(path).parent_path();
  require_option(folder.empty() || fs::is_directory(folder), option,
                 "found \"{}\", expected a file in an existing folder: \"{}\" does not exist", path,
                 folder.string());
}

}  // namespace

std::string check_file_name(const std::string& name) {
  return name.empty() ? "found '', expected the name of a file" : "";
}

std::string check_folder_name(const std::string& name) {
  return name.empty() ? "found '', expected the name of a folder" : "";
}

std::function<std::string(const std::string&)> check_value(const base::Domain& domain) {
  return [domain](const std::string& text) {
    return domain.allows(parse_scalar(text, domain.kind))
               ? ""
               : fmt::format("found {}, expected {}", text, domain.describe());
  };
}

CLI::Option* add_names_option(CLI::App& app, const std::string& option,
                              const std::function<void(std::vector<std::string>)>& take,
                              const std::string& help) {
  const auto split = [option, take](const std::vector<std::string>& texts) {
    std::vector<std::string> names;
    for (const auto& text : texts)
      for (const auto name : base::split(text, ',')) {
        require_option(!name.empty(), option, "found '{}', expected names separated by commas",
                       text);
        names.emplace_back(name);
      }
    take(std::move(names));
  };
  return app.add_option_function<std::vector<std::string>>(option, split, help)
      ->allow_extra_args(false);
}

void add_set_option(CLI::App& command, Overrides& overrides, const std::string& help) {
  const auto set = [&overrides](const std::vector<std::string>& texts) {
    for (const auto& text : texts) overrides.push_back(parse_override(text));
  };
  command.add_option_function<std::vector<std::string>>("--set", set, help)
      ->allow_extra_args(false);
}

void add_figure_options(CLI::App& command, FigureSpec& figure) {
  bind_options(command, figure_fields(), figure);
}

void add_run_options(CLI::App& command, RunOptions& options, const std::string& output,
                     const std::string& set) {
  options.jobs = std::max(1u, std::thread::hardware_concurrency());
  command.add_option("-o,--output", options.output, output)->check(check_folder_name);
  command.add_flag("--reduced", options.is_reduced,
                   "quick trial: replace keys by those in the file's section [reduced]");
  add_set_option(command, options.overrides, set);
  bind_options<RunOptions>(command,
                           {base::Declare<RunOptions>::whole("jobs", &RunOptions::jobs, 1, 1024, "",
                                                             "points to run in parallel")},
                           options);
}

CLI::Option* add_field_option(CLI::App& app, const std::string& name, const std::string& help,
                              const base::Domain& domain, const base::Scalar& standard,
                              const std::function<std::string(const base::Scalar&)>& assign) {
  std::string option = "--" + name;
  std::ranges::replace(option, '_', '-');
  const auto set = [option, kind = domain.kind, assign](const std::string& text) {
    const auto expected = assign(parse_scalar(text, kind));
    require_option(expected.empty(), option, "found {}, expected {}", text, expected);
  };
  return app.add_option_function<std::string>(option, set, help)
      ->option_text(fmt::format("{} [{}]", describe(domain), describe_default(domain, standard)));
}

CLI::Option* add_key_option(CLI::App& app, const std::string& name, const std::string& key,
                            Overrides& overrides, const std::string& help) {
  const auto all = settings();
  const auto setting = std::ranges::find(all, key, &Setting::key);
  if (setting == all.end()) throw base::InvariantBroken("no key " + key);
  const auto set = [key, domain = setting->domain, &overrides](const base::Scalar& value) {
    if (!domain.allows(value)) return domain.describe();
    overrides.push_back({key, make_node(value)});
    return std::string();
  };
  return add_field_option(app, name, help, setting->domain, setting->standard, set);
}

nlohmann::ordered_json make_json(const renderer::Work& work) {
  nlohmann::ordered_json counts;
  for (std::size_t i = 0; i < renderer::OP_COUNT; ++i)
    counts[std::string(renderer::op_names()[i])] = work.counts[i];
  return counts;
}

nlohmann::ordered_json make_json(const renderer::RayCounts& rays) {
  return {{"probes", rays.probes},
          {"primary", rays.primary},
          {"primary_hit", rays.primary_hit},
          {"reflected", rays.reflected},
          {"transmitted", rays.transmitted},
          {"shadow", rays.shadow},
          {"total", rays.total()}};
}

void check_apart(const std::string& option, const std::string& file,
                 std::initializer_list<std::string> others) {
  for (const auto& other : others)
    require_option(file.empty() || other.empty() || whole_path(file) != whole_path(other), option,
                   "found \"{}\", expected a file that no other option uses", file);
}

void check_output(const std::string& output, const std::vector<std::string>& endings,
                  const std::string& stats) {
  const auto ending = fs::path(output).extension().string();
  require_option(ending.empty() || std::ranges::find(endings, ending) != endings.end(), "--output",
                 "found \"{}\", expected a name that ends in {}", output,
                 fmt::join(endings, " or "));
  check_apart("--stats", stats, {output});
  check_folder("--output", output);
  check_folder("--stats", stats);
}

void check_can_save_all(std::initializer_list<std::string> files) {
  for (const auto& file : files)
    if (!file.empty()) base::check_can_save(file);
}

void make_folder(const std::string& option, const std::string& path) {
  std::error_code failed;
  fs::create_directories(path, failed);
  require_option(!failed, option, "found \"{}\", expected a folder: {}", path, failed.message());
}

}  // namespace laboratory
