#include "experiments/laboratory/command/options.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace laboratory {

namespace {

namespace fs = std::filesystem;
using Kind = base::Domain::Kind;

template <class T>
std::optional<T> parse(const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return {};
  return value;
}

base::Scalar parse_scalar(const std::string& text, Kind kind) {
  if (kind == Kind::whole || kind == Kind::number) {
    if (const auto whole = parse<std::int64_t>(text)) return *whole;
    if (const auto number = parse<double>(text)) return *number;
  }
  return text;
}

std::string describe(const base::Scalar& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return std::get<std::string>(value);
}

std::string describe(const base::Domain& domain) {
  if (domain.kind == Kind::choice) return fmt::format("{}", fmt::join(domain.choices, "|"));
  return domain.kind == Kind::text ? "TEXT" : fmt::format("{}..{}", domain.low, domain.high);
}

fs::path whole_path(const std::string& path) {
  std::error_code ignored;
  return fs::weakly_canonical(path, ignored);
}

void check_folder(const std::string& option, const std::string& path) {
  const auto folder = fs::path(path).parent_path();
  if (folder.empty() || fs::is_directory(folder)) return;
  throw CLI::ValidationError(
      option, fmt::format("found \"{}\", expected a file in a folder that is there: \"{}\" is none",
                          path, folder.string()));
}

}  // namespace

void add_field_option(CLI::App& app, const std::string& name, const std::string& help,
                      const base::Domain& domain, const base::Scalar& standard,
                      const std::function<std::string(const base::Scalar&)>& assign) {
  std::string option = "--" + name;
  std::ranges::replace(option, '_', '-');
  const auto set = [option, kind = domain.kind, assign](const std::string& text) {
    const auto expected = assign(parse_scalar(text, kind));
    if (!expected.empty())
      throw CLI::ValidationError(option, fmt::format("found {}, expected {}", text, expected));
  };
  app.add_option_function<std::string>(option, set, help)
      ->option_text(fmt::format("{} [{}]", describe(domain), describe(standard)));
}

void check_output(const std::string& output, const std::vector<std::string>& endings,
                  const std::string& stats) {
  const auto ending = fs::path(output).extension().string();
  if (!ending.empty() && std::ranges::find(endings, ending) == endings.end())
    throw CLI::ValidationError("--output",
                               fmt::format("found \"{}\", expected a name that ends in {}", output,
                                           fmt::join(endings, " or ")));
  if (!stats.empty() && whole_path(stats) == whole_path(output))
    throw CLI::ValidationError("--stats", "expected another file than the image's");
  check_folder("--output", output);
  check_folder("--stats", stats);
}

}  // namespace laboratory
