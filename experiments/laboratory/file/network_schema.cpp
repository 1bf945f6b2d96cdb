#include "experiments/laboratory/file/network_schema.hpp"

#include "base/errors.hpp"
#include "experiments/laboratory/file/binding.hpp"

namespace laboratory {

namespace {

using base::BadInput;

constexpr int MOST = topologies::MAX_PROCESSORS - 1;
constexpr double LONGEST_S = 1e9;

// Two processors; none for what is no pair of them.
std::optional<std::pair<int, int>> read_pair(const toml::node& node) {
  const auto* list = node.as_array();
  if (!list || list->size() != 2) return std::nullopt;
  std::array<int, 2> ends{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto number = (*list)[i].value_exact<std::int64_t>();
    if (!number || *number < 0 || *number > MOST) return std::nullopt;
    ends[i] = static_cast<int>(*number);
  }
  return std::pair(ends[0], ends[1]);
}

struct FaultRecord {
  std::string name;  // "[[fault]] 2"
  std::optional<double> at_s = {};
  std::optional<int> processor = {};
  std::optional<std::pair<int, int>> link = {};

  Place locate(const Place& at) const {
    return {at.origin, fmt::format("{}: {}", name, at.key), at.folder, at.node};
  }
};

const std::vector<Binding<FaultRecord>>& bindings() {
  using F = FaultRecord;
  using P = Place;
  static const std::vector<Binding<F>> all = {
      {"link", "[a, b]: the link between these processors carries nothing any more",
       [](F& f, const P& at) {
         f.link = read_pair(at.node);
         if (!f.link) f.locate(at).refuse("two processors that a link joins, [a, b]");
       }},
      {"processor", "or this processor stops, and its links with it",
       [](F& f, const P& at) { f.processor = int(read_int(f.locate(at), 0, MOST)); }},
      {"at_s", "when it happens, from the start of the program; s",
       [](F& f, const P& at) { f.at_s = read_double(f.locate(at), 0, LONGEST_S); }},
  };
  return all;
}

FaultSpec bind_fault(const toml::table& table, const Place& at, std::size_t number) {
  FaultRecord fault{fmt::format("[[fault]] {}", number)};
  for (auto&& [key, node] : table)
    bind_one(fault, bindings(), {at.origin, std::string(key.str()), at.folder, node});
  const auto place = fmt::format("{}: {}", Place{at.origin, "", "", table}.where(), fault.name);
  if (fault.link.has_value() == fault.processor.has_value())
    throw BadInput(
        fmt::format("{}: found {}, expected either link = [a, b] or processor = n", place,
                    fault.link ? "both a link and a processor" : "no link and no processor"));
  if (!fault.at_s)
    throw BadInput(fmt::format("{}: \"at_s\" is missing, expected when it happens", place));
  if (fault.processor) return {{*fault.at_s, *fault.processor}, place};
  return {{*fault.at_s, fault.link->first, fault.link->second}, place};
}

bool is_empty_list(const Place& at) { return at.node.is_array() && at.node.as_array()->empty(); }

}  // namespace

topologies::TreeLinks read_tree_links(const Place& at) {
  const std::string expected = "the links of a spanning tree, [[a, b], ...]";
  const auto* list = at.node.as_array();
  if (!list) at.refuse(expected);
  topologies::TreeLinks links;
  for (const auto& node : *list) {
    const auto link = read_pair(node);
    if (!link) at.refuse(expected);
    links.push_back(*link);
  }
  return links;
}

std::vector<FaultSpec> read_faults(const Place& at) {
  std::vector<FaultSpec> faults;
  if (is_empty_list(at)) return faults;
  for (const auto* table : read_tables(at))
    faults.push_back(bind_fault(*table, at, faults.size() + 1));
  return faults;
}

const std::vector<Setting>& fault_settings() {
  static const std::vector<Setting> all = [] {
    std::vector<Setting> list;
    for (const auto& b : bindings()) list.push_back({"fault." + b.key, b.help});
    return list;
  }();
  return all;
}

}  // namespace laboratory
