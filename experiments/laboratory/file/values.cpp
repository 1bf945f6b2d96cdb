#include "experiments/laboratory/file/values.hpp"

#include <filesystem>
#include <sstream>

#include "base/message.hpp"

namespace laboratory {

std::string Place::where() const {
  const auto line = node.source().begin.line;  // line number; 0 for a value from --set
  return line > 0 ? fmt::format("{}:{}", origin, line) : fmt::format("{}, with --set", origin);
}

void Place::refuse(const std::string& expected) const {
  throw base::BadInput(
      fmt::format("{}: {}{}: found {}, expected {}", where(), owner, key, to_toml(node), expected));
}

std::int64_t read_int(const Place& at, std::int64_t low, std::int64_t high) {
  const auto value = at.node.value_exact<std::int64_t>();
  if (!value || *value < low || *value > high)
    at.refuse(fmt::format("a whole number from {} to {}", low, high));
  return *value;
}

double read_double(const Place& at, double low, double high) {
  const auto value = at.node.is_number() ? at.node.value<double>() : std::nullopt;
  if (!value || !(*value >= low && *value <= high))
    at.refuse(fmt::format("a number from {} to {}", low, high));
  return *value;
}

std::string read_text(const Place& at) {
  const auto value = at.node.value_exact<std::string>();
  if (!value) at.refuse("a text in quotes");
  return *value;
}

void read(const Place& at, std::string& text) { text = read_text(at); }

void read(const Place& at, bool& flag) {
  const auto value = at.node.value_exact<bool>();
  if (!value) at.refuse("true or false");
  flag = *value;
}

void read(const Place& at, std::vector<std::string>& texts) {
  const auto* list = at.node.as_array();
  if (!list || list->empty() || !list->is_homogeneous<std::string>()) at.refuse("a list of texts");
  texts.clear();
  for (const auto& node : *list) texts.push_back(*node.value_exact<std::string>());
}

base::Source read_file_name(const Place& at) {
  const auto text = read_text(at);
  return {text, text.empty() ? "" : (std::filesystem::path(at.folder) / text).string()};
}

void read(const Place& at, base::Source& source) {
  const std::filesystem::path path(read_text(at));
  const bool is_name = !path.has_extension() || path.is_absolute();
  source = is_name ? base::Source{path.string(), path.string()} : read_file_name(at);
}

base::Scalar read_scalar(const Place& at, const base::Domain& domain) {
  using Kind = base::Domain::Kind;
  const auto& node = at.node;
  if (node.is_string() && domain.kind == Kind::source) {
    base::Source source;
    read(at, source);
    return source;
  }
  if (node.is_string() && domain.kind == Kind::file) return read_file_name(at);
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto whole = node.value_exact<std::int64_t>()) return *whole;
  if (const auto number = node.value_exact<double>()) return *number;
  if (const auto flag = node.value_exact<bool>()) return *flag;
  std::vector<double> numbers;
  if (!node.is_array()) return {};
  for (const auto& entry : *node.as_array()) {
    const auto number = entry.is_number() ? entry.value<double>() : std::nullopt;
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<const toml::table*> tables_of(const Place& at, bool may_be_empty) {
  const auto* list = at.node.as_array();
  std::vector<const toml::table*> tables;
  if (list && list->empty() && may_be_empty) return tables;
  if (!list || !list->is_array_of_tables()) at.refuse(fmt::format("one or more [[{}]]", at.key));
  for (const auto& node : *list) tables.push_back(node.as_table());
  return tables;
}

void refuse_key(const Place& at, const std::vector<std::string>& known) {
  const auto same_end = std::ranges::find_if(
      known, [&](const std::string& key) { return key.ends_with("." + at.key); });
  const auto& near = same_end != known.end() ? std::vector{*same_end} : known;
  base::refuse(at.where(), "unknown key \"{}\"{}", at.key,
               base::suggest(at.key, near, "the nearest valid key is"));
}

void for_each_key(const toml::table& file,
                  const std::function<void(const std::string& key, const toml::node&)>& visit) {
  static constexpr std::array<std::string_view, 8> NOT_OF_A_POINT = {
      "sweep", "let", "check", "plot", "best", "baseline", "report", "uncertain"};
  for (auto&& [section, content] : file) {
    const std::string name(section.str());
    if (std::ranges::find(NOT_OF_A_POINT, name) != NOT_OF_A_POINT.end()) continue;
    if (!content.is_table()) {
      visit(name, content);
      continue;
    }
    for (auto&& [key, node] : *content.as_table()) {
      const auto dotted = fmt::format("{}.{}", name, key.str());
      if (name != "model" || !node.is_table()) {
        visit(dotted, node);
        continue;
      }
      for (auto&& [entry, value] : *node.as_table())
        visit(fmt::format("{}.{}", dotted, entry.str()), value);
    }
  }
}

std::string spell_text(const std::string& text) {
  using enum toml::format_flags;
  const toml::value<std::string> value(text);
  std::ostringstream spelled;
  spelled << toml::toml_formatter(value, toml::toml_formatter::default_flags &
                                             ~(allow_literal_strings | allow_multi_line_strings));
  return spelled.str();
}

}  // namespace laboratory
