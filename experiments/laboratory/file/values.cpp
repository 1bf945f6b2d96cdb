#include "experiments/laboratory/file/values.hpp"

#include <filesystem>
#include <sstream>

#include "base/message.hpp"

namespace laboratory {

std::string Place::where() const {
  const auto line = node.source().begin.line;  // 0 for a value from --set
  return line > 0 ? fmt::format("{}:{}", origin, line) : fmt::format("{}, with --set", origin);
}

void Place::refuse(const std::string& expected) const {
  throw base::BadInput(
      fmt::format("{}: {}{}: found {}, expected {}", where(), owner, key, to_toml(node), expected));
}

namespace {

// Spells a number; no value if the node is not a finite number.
std::optional<std::string> find_number_text(const toml::node& node) {
  const auto number = node.value<double>();
  if (!node.is_number() || !std::isfinite(*number)) return std::nullopt;
  return fmt::format("{}", *number);
}

// Reads a list of strings; no value for other lists. If `are_expressions`, numbers also count as
// strings.
base::Scalar read_texts(const toml::array& list, bool are_expressions) {
  std::vector<std::string> texts;
  for (const auto& entry : list) {
    const auto number = are_expressions ? find_number_text(entry) : std::nullopt;
    if (const auto text = number ? number : entry.value_exact<std::string>())
      texts.push_back(*text);
  }
  return texts.size() == list.size() ? base::Scalar(texts) : base::Scalar();
}

// Reads a list of numbers, or of lists of numbers; no value for other lists.
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

// Finds the path of a file, relative to `folder`. If `is_source`, a text without an extension is a
// name such as "tree:7", not a file.
base::Source make_source(const std::string& text, const std::string& folder, bool is_source) {
  const std::filesystem::path path(text);
  const bool is_name = is_source && (!path.has_extension() || path.is_absolute());
  if (is_name || text.empty()) return {text, text};
  return {text, (std::filesystem::path(folder) / path).string()};
}

}  // namespace

base::Scalar read_value(const Place& at, const base::Domain& domain) {
  using Kind = base::Domain::Kind;
  const auto& node = at.node;
  base::Scalar value;
  if (const auto text = node.value_exact<std::string>()) {
    const bool is_source = domain.kind == Kind::source;
    if (is_source || domain.kind == Kind::file)
      value = make_source(*text, at.folder, is_source);
    else if (domain.kind == Kind::texts)
      value = std::vector{*text};
    else
      value = *text;
  } else if (const auto* list = node.as_array()) {
    const bool are_expressions = domain.kind == Kind::expressions;
    const bool are_texts = are_expressions || domain.kind == Kind::texts;
    value = are_texts ? read_texts(*list, are_expressions) : read_list(*list);
  } else if (const auto number = find_number_text(node);
             number && domain.kind == Kind::expression) {
    value = *number;
  } else if (const auto whole = node.value_exact<std::int64_t>()) {
    value = *whole;
  } else if (const auto real = node.value_exact<double>()) {
    value = *real;
  } else if (const auto flag = node.value_exact<bool>()) {
    value = *flag;
  }
  const auto* source = std::get_if<base::Source>(&value);
  if (source && source->text.find('\0') != std::string::npos)
    at.refuse("the name of a file, without a zero byte");
  if (domain.allows(value)) return value;
  const auto* text = std::get_if<std::string>(&value);
  at.refuse(domain.describe() +
            (text && !domain.choices.empty() ? base::did_you_mean(*text, domain.choices) : ""));
}

std::string read_expression(const Place& at) {
  return std::get<std::string>(read_value(at, {base::Domain::Kind::expression}));
}

void check_tables(const Place& at, bool may_be_empty) {
  const auto* list = at.node.as_array();
  if (list && list->empty() && may_be_empty) return;
  if (!list || !list->is_array_of_tables()) at.refuse(fmt::format("one or more [[{}]]", at.key));
}

void refuse_key(const Place& at, const std::vector<std::string>& known) {
  const auto same_end = std::ranges::find_if(
      known, [&](const std::string& key) { return key.ends_with("." + at.key); });
  const auto& near = same_end != known.end() ? std::vector{*same_end} : known;
  base::refuse(at.where(), "unknown key \"{}\"{}", at.key,
               base::suggest(at.key, near, "the nearest valid key is"));
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
