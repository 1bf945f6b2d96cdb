#include "experiments/laboratory/file/values.hpp"

#include <array>
#include <filesystem>
#include <sstream>

#include "base/errors.hpp"

namespace laboratory {

namespace {

constexpr std::array<std::string_view, 6> NOT_OF_A_POINT = {"sweep", "let",  "check",
                                                            "plot",  "best", "report"};

}  // namespace

std::string Place::where() const {
  const auto line = node.source().begin.line;  // 0 for a value from --set
  return line > 0 ? fmt::format("{}:{}", origin, line) : fmt::format("{}, with --set", origin);
}

void Place::refuse(const std::string& expected) const {
  throw base::BadInput(
      fmt::format("{}: {}: found {}, expected {}", where(), key, to_toml(node), expected));
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

bool read_bool(const Place& at) {
  const auto value = at.node.value_exact<bool>();
  if (!value) at.refuse("true or false");
  return *value;
}

std::string read_text(const Place& at) {
  const auto value = at.node.value_exact<std::string>();
  if (!value) at.refuse("a text in quotes");
  return *value;
}

std::vector<std::string> read_texts(const Place& at) {
  const auto* list = at.node.as_array();
  if (!list || list->empty()) at.refuse("a list of texts");
  std::vector<std::string> texts;
  for (const auto& node : *list) {
    const auto text = node.value_exact<std::string>();
    if (!text) at.refuse("a list of texts");
    texts.push_back(*text);
  }
  return texts;
}

void read_switches(const Place& at, int& all, std::vector<std::array<int, 3>>& between) {
  constexpr int MOST = 16;
  const std::string expected =
      fmt::format("a whole number from 0 to {}, or a list of [worker, worker, number]", MOST);
  if (at.node.is_integer()) {
    all = static_cast<int>(read_int(at, 0, MOST));
    return;
  }
  const auto* list = at.node.as_array();
  if (!list) at.refuse(expected);
  between.clear();
  for (const auto& node : *list) {
    const auto* triple = node.as_array();
    if (!triple || triple->size() != 3) at.refuse(expected);
    std::array<int, 3> v{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto number = (*triple)[i].value_exact<std::int64_t>();
      if (!number || *number < 0 || *number > (i < 2 ? 16384 : MOST)) at.refuse(expected);
      v[i] = static_cast<int>(*number);
    }
    between.push_back(v);
  }
}

base::Source read_file_name(const Place& at) {
  const auto text = read_text(at);
  return {text, text.empty() ? "" : (std::filesystem::path(at.folder) / text).string()};
}

base::Source read_source(const Place& at) {
  const std::filesystem::path path(read_text(at));
  const bool is_name = !path.has_extension() || path.is_absolute();
  return is_name ? base::Source{path.string(), path.string()} : read_file_name(at);
}

base::Scalar read_scalar(const Place& at, const base::Domain& domain) {
  using Kind = base::Domain::Kind;
  const auto& node = at.node;
  if (node.is_string() && domain.kind == Kind::source) return read_source(at);
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

std::vector<const toml::table*> read_tables(const Place& at) {
  const auto* list = at.node.as_array();
  if (!list || list->empty()) at.refuse(fmt::format("one or more [[{}]]", at.key));
  std::vector<const toml::table*> tables;
  for (const auto& node : *list) {
    if (!node.is_table()) at.refuse(fmt::format("one or more [[{}]]", at.key));
    tables.push_back(node.as_table());
  }
  return tables;
}

std::string to_toml(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& n) { text << n; });
  return text.str();
}

void for_each_key(const toml::table& file,
                  const std::function<void(const std::string& key, const toml::node&)>& visit) {
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

}  // namespace laboratory
