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

namespace {

// A list of numbers, or of lists of numbers; no value for other lists.
base::Scalar read_list(const toml::array& list) {
  std::vector<double> numbers;
  std::vector<std::vector<double>> rows;
  for (const auto& entry : list) {
    const auto inner = entry.is_array() ? read_list(*entry.as_array()) : base::Scalar();
    if (entry.is_number()) numbers.push_back(*entry.value<double>());
    if (const auto* row = std::get_if<std::vector<double>>(&inner)) rows.push_back(*row);
  }
  if (numbers.size() == list.size()) return numbers;
  return rows.size() == list.size() ? base::Scalar(rows) : base::Scalar();
}

// Makes the path of a file in the folder. If `is_source`, a text without an extension is not a file
// but a name, such as "tree:7".
base::Source make_source(const std::string& text, const std::string& folder, bool is_source) {
  const std::filesystem::path path(text);
  const bool is_name = is_source && (!path.has_extension() || path.is_absolute());
  if (is_name || text.empty()) return {text, text};
  return {text, (std::filesystem::path(folder) / path).string()};
}

// Reads a text. If `is_expression`, also accepts a number and formats it.
std::optional<std::string> find_text(const toml::node& node, bool is_expression) {
  const auto number = is_expression && node.is_number() ? node.value<double>() : std::nullopt;
  return number && std::isfinite(*number) ? fmt::format("{}", *number)
                                          : node.value_exact<std::string>();
}

base::Scalar read_scalar(const Place& at, const base::Domain& domain) {
  using Kind = base::Domain::Kind;
  const auto& node = at.node;
  const bool are_expressions = domain.kind == Kind::expressions;
  if (const auto text = find_text(node, domain.kind == Kind::expression)) {
    if (domain.kind == Kind::texts) return std::vector{*text};
    if (domain.kind == Kind::source || domain.kind == Kind::file)
      return make_source(*text, at.folder, domain.kind == Kind::source);
    return *text;
  }
  if (const auto whole = node.value_exact<std::int64_t>()) return *whole;
  if (const auto number = node.value_exact<double>()) return *number;
  if (const auto flag = node.value_exact<bool>()) return *flag;
  if (!node.is_array()) return {};
  if (domain.kind != Kind::texts && !are_expressions) return read_list(*node.as_array());
  std::vector<std::string> texts;
  for (const auto& entry : *node.as_array())
    if (const auto text = find_text(entry, are_expressions)) texts.push_back(*text);
  return texts.size() == node.as_array()->size() ? base::Scalar(texts) : base::Scalar();
}

}  // namespace

base::Scalar read_value(const Place& at, const base::Domain& domain) {
  auto value = read_scalar(at, domain);
  if (domain.allows(value)) return value;
  const auto* text = std::get_if<std::string>(&value);
  at.refuse(domain.describe() +
            (text && !domain.choices.empty() ? base::did_you_mean(*text, domain.choices) : ""));
}

std::string read_expression(const Place& at) {
  return std::get<std::string>(read_value(at, {base::Domain::Kind::expression}));
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
