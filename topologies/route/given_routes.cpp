#include "topologies/route/given_routes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string_view>

#include "base/errors.hpp"
#include "base/whole_file.hpp"

namespace topologies {
namespace {

constexpr std::string_view BLANKS = " \t\r";
constexpr std::string_view COLUMNS = "from,to,path";

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(BLANKS);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(BLANKS) - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (size_t at = 0; at <= text.size();) {
    const auto end = std::min(text.find(separator, at), text.size());
    parts.push_back(trim(text.substr(at, end - at)));
    at = end + 1;
  }
  return parts;
}

// Where a message for an end goes on a given path, and the path's line.
struct Step {
  int next, line;
};

struct Reader {
  const Topology& topology;
  const std::string& name;
  std::map<int, std::map<int, Step>> steps = {};  // of each end, at each processor
  std::map<int, std::string> paths = {};          // of each line
  int line = 0;

  [[noreturn]] void refuse(const std::string& what) const {
    throw base::BadInput(fmt::format("{}:{}: {}", name, line, what));
  }

  int read_processor(std::string_view text) const {
    int number = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < 0 ||
        number >= topology.processors)
      refuse(fmt::format("found \"{}\", expected a processor from 0 to {}", text,
                         topology.processors - 1));
    return number;
  }

  std::vector<int> read_path(std::string_view text, int from, int to) const {
    std::vector<int> path;
    for (const auto part : split(text, '-')) path.push_back(read_processor(part));
    if (path.size() < 2 || path.front() != from || path.back() != to)
      refuse(fmt::format("found the path {}, expected one from {} to {}", text, from, to));
    if (std::set<int>(path.begin(), path.end()).size() < path.size())
      refuse(fmt::format("found the path {}, expected each processor once", text));
    return path;
  }

  // Of a path or its reverse.
  void add_steps(const std::vector<int>& path) {
    for (size_t i = 0; i + 1 < path.size(); ++i) {
      const int at = path[i], next = path[i + 1];
      const auto [known, added] = steps[path.back()].try_emplace(at, Step{next, line});
      if (!added && known->second.next != next)
        refuse(fmt::format(
            "the path {} leads from {} to {} by {}, but that of line {}, {}, by {}; expected one "
            "way from a processor to an end",
            paths[line], at, path.back(), next, known->second.line, paths[known->second.line],
            known->second.next));
    }
  }

  void check_links(const std::vector<int>& path,
                   const std::vector<std::vector<Neighbour>>& around) const {
    for (size_t i = 0; i + 1 < path.size(); ++i)
      if (std::ranges::find(around[path[i]], path[i + 1], &Neighbour::processor) ==
          around[path[i]].end())
        refuse(fmt::format("found a step from {} to {}, but no link of {} joins the two", path[i],
                           path[i + 1], topology.name));
  }

  void read(const std::string& text) {
    const auto around = neighbours(topology);
    bool has_columns = false;
    const std::string_view whole(text), mark("\xEF\xBB\xBF");
    for (const auto row : split(whole.substr(whole.starts_with(mark) ? mark.size() : 0), '\n')) {
      ++line;
      if (row.empty() || row.starts_with('#')) continue;
      const auto cells = split(row, ',');
      if (!has_columns) {
        has_columns = cells == split(COLUMNS, ',');
        if (!has_columns) refuse(fmt::format("found \"{}\", expected columns {}", row, COLUMNS));
        continue;
      }
      if (cells.size() != 3) refuse(fmt::format("found \"{}\", expected {}", row, COLUMNS));
      auto path = read_path(cells[2], read_processor(cells[0]), read_processor(cells[1]));
      paths[line] = cells[2];
      check_links(path, around);
      add_steps(path);
      std::ranges::reverse(path);
      add_steps(path);
    }
    if (!has_columns)
      throw base::BadInput(fmt::format("{}: found no columns, expected {}", name, COLUMNS));
  }
};

// Puts the given steps towards one end into the table, and how far everybody is from it then.
void apply(RoutingTable& table, const std::vector<std::vector<Neighbour>>& around, int to,
           const std::map<int, Step>& steps) {
  const int n = table.processors;
  std::vector<int> port(n, 0), next(n, to), distance(n, -1);
  for (int at = 0; at < n; ++at) {
    if (at == to) continue;
    const auto given = steps.find(at);
    const auto hop = std::ranges::find_if(around[at], [&](const Neighbour& neighbour) {
      return given != steps.end() ? neighbour.processor == given->second.next
                                  : neighbour.port == table.next_port(at, to);
    });
    port[at] = hop->port;
    next[at] = hop->processor;
  }
  distance[to] = 0;
  std::vector<int> way;
  for (int from = 0; from < n; ++from) {
    for (int at = from; distance[at] < 0; at = next[at]) way.push_back(at);
    for (; !way.empty(); way.pop_back()) distance[way.back()] = distance[next[way.back()]] + 1;
  }
  for (int from = 0; from < n; ++from)
    if (from != to)
      table.hops[static_cast<size_t>(to) * n + from] =
          static_cast<std::uint16_t>(distance[from] * PORTS + port[from]);
}

}  // namespace

RoutingTable read_routes(const Topology& topology, const std::string& text,
                         const std::string& name) {
  Reader reader{topology, name};
  reader.read(text);
  auto table = make_routes(topology);
  const auto around = neighbours(topology);
  for (const auto& [to, steps] : reader.steps) apply(table, around, to, steps);
  return table;
}

RoutingTable load_routes(const Topology& topology, const std::string& path) {
  return read_routes(topology, base::read_text(path, MAX_FILE_BYTES), path);
}

}  // namespace topologies
