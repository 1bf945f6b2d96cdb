#include "topologies/route/given_routes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <string_view>

#include "base/csv.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "topologies/route/packed_ports.hpp"

namespace topologies {
namespace {

const std::vector<std::string> COLUMNS{"from", "to", "path"};

struct Row {
  int line;
  std::string text;  // the path as spelled in the file
  std::vector<int> path;
};

// The next processor on a path from the file, and the row of the file that holds the path.
struct Step {
  int next;
  const Row* row;
};

class Reader {
 public:
  using Steps = std::map<int, Step>;  // by the processor at which the step begins

  Reader(const Topology& topology, const std::string& text, const std::string& name)
      : topology_(topology), around_(neighbours(topology)), csv_(text, name) {
    const auto columns = csv_.take_header();
    if (columns != COLUMNS) refuse_row(columns);
    for (auto row = csv_.take(); !row.empty(); row = csv_.take()) {
      if (base::is_blank(row)) continue;
      std::vector<std::string> cells;
      for (auto& cell : row) cells.push_back(std::move(cell.text));
      if (cells.size() != COLUMNS.size()) refuse_row(cells);
      auto path = read_path(cells[2], read_processor(cells[0]), read_processor(cells[1]));
      check_links(path);
      given_.insert({path.front(), path.back()});
      rows_.push_back({csv_.line(), cells[2], std::move(path)});
    }
    for (const Row& row : rows_) {
      add_steps(row, row.path);
      if (!given_.contains({row.path.back(), row.path.front()}))
        add_steps(row, {row.path.rbegin(), row.path.rend()});
    }
  }

  const std::map<int, Steps>& steps() const { return steps_; }

 private:
  [[noreturn]] void refuse_row(const std::vector<std::string>& cells) const {
    csv_.fail(
        fmt::format("found \"{}\", expected {}", fmt::join(cells, ","), fmt::join(COLUMNS, ",")));
  }

  int read_processor(std::string_view text) const {
    const auto number = base::parse_number<int>(text);
    if (!number || *number < 0 || *number >= topology_.processors)
      csv_.fail(fmt::format("found \"{}\", expected a processor from 0 to {}", text,
                            topology_.processors - 1));
    return *number;
  }

  std::vector<int> read_path(std::string_view text, int from, int to) const {
    std::vector<int> path;
    for (const auto part : base::split(text, '-')) path.push_back(read_processor(part));
    if (path.size() < 2 || path.front() != from || path.back() != to)
      csv_.fail(fmt::format("found the path {}, expected a path from {} to {}", text, from, to));
    if (std::set<int>(path.begin(), path.end()).size() < path.size())
      csv_.fail(fmt::format("found the path {}, expected each processor at most once", text));
    return path;
  }

  void check_links(const std::vector<int>& path) const {
    for (size_t i = 0; i + 1 < path.size(); ++i)
      if (std::ranges::find(around_[path[i]], path[i + 1], &Neighbour::processor) ==
          around_[path[i]].end())
        csv_.fail(fmt::format("found a step from {} to {}, expected a link of {}", path[i],
                              path[i + 1], topology_.name));
  }

  // Adds the steps of `path`, which is the path of `row` in one of its two directions.
  void add_steps(const Row& row, const std::vector<int>& path) {
    for (size_t i = 0; i + 1 < path.size(); ++i) {
      const int at = path[i], next = path[i + 1];
      const auto [known, added] = steps_[path.back()].try_emplace(at, Step{next, &row});
      if (const Step& other = known->second; !added && other.next != next)
        csv_.fail_at(
            row.line,
            fmt::format("found the path {0}, which goes from {1} to {2} by {3}, and in line {4} "
                        "the path {5}, which goes by {6}; expected the same next processor",
                        row.text, at, path.back(), next, other.row->line, other.row->text,
                        other.next));
    }
  }

  const Topology& topology_;
  std::vector<std::vector<Neighbour>> around_;
  base::CsvReader csv_;
  std::deque<Row> rows_;
  std::set<std::pair<int, int>> given_;  // pairs (from, to) for which the file has a row
  std::map<int, Steps> steps_;           // by the last processor of the paths
};

// Routes that follow the given paths to their destinations. All other pairs of processors use the
// routes in `others`.
class GivenRule : public Rule {
 public:
  GivenRule(const Topology& topology, RoutingTable others,
            const std::map<int, Reader::Steps>& steps_to)
      : Rule(topology), others_(std::move(others)) {
    for (const auto& [to, steps] : steps_to) given_.emplace(to, find_ports(to, steps));
  }

  int next_port(int from, int to) const override {
    const auto given = given_.find(to);
    return given == given_.end() ? others_.next_port(from, to) : given->second.get(from);
  }

  RouteSum sum() const override {
    auto sum = others_.rule->sum();
    for (const auto& [to, ports] : given_) {
      const auto other = others_.rule->sum_to(to);
      sum += sum_to(to);
      sum += {-other.links, -other.pairs};
    }
    return sum;
  }

 private:
  PackedPorts find_ports(int to, const Reader::Steps& steps) const {
    PackedPorts ports(processors());
    for (int at = 0; at < processors(); ++at) {
      if (at == to) continue;
      const auto given = steps.find(at);
      ports.set(at, given == steps.end()
                        ? others_.next_port(at, to)
                        : static_cast<int>(std::ranges::find(peers()[at], given->second.next) -
                                           peers()[at].begin()));
    }
    return ports;
  }

  RoutingTable others_;
  // First ports of routes by destination, for destinations of given paths.
  std::map<int, PackedPorts> given_;
};

}  // namespace

RoutingTable read_routes(const Topology& topology, const std::string& text,
                         const std::string& name) {
  const Reader reader(topology, text, name);
  return make_table(std::make_shared<GivenRule>(topology, make_routes(topology), reader.steps()));
}

RoutingTable load_routes(const Topology& topology, const std::string& path) {
  return read_routes(topology, base::read_text(path, MAX_FILE_BYTES), path);
}

RoutingTable find_routes(const Topology& topology, const std::string& name) {
  if (name.empty()) return make_routes(topology);
  return name == XY_ROUTES ? make_xy_routes(topology) : load_routes(topology, name);
}

}  // namespace topologies
