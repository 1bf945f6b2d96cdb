#include "simulator/network/destinations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "base/csv.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "topologies/route/route_load.hpp"

namespace network {

namespace {

const base::Names<Pattern> PATTERNS = {{"uniform", Pattern::uniform},
                                       {"transpose", Pattern::transpose},
                                       {"bit_complement", Pattern::bit_complement},
                                       {"bit_reversal", Pattern::bit_reversal},
                                       {"shuffle", Pattern::shuffle},
                                       {"hot_spot", Pattern::hot_spot},
                                       {"neighbour", Pattern::neighbour},
                                       {"file", Pattern::file}};

constexpr const char* PATTERN = "program.pattern";

int find_side(int processors) {
  const int side = static_cast<int>(std::lround(std::sqrt(processors)));
  base::require(side * side == processors, PATTERN,
                "transpose: found {} processors, expected a square number", processors);
  return side;
}

int count_bits(const std::string& name, int processors) {
  base::require(std::has_single_bit(static_cast<unsigned>(processors)), PATTERN,
                "{}: found {} processors, expected a power of two", name, processors);
  return std::countr_zero(static_cast<unsigned>(processors));
}

int reverse_bits(int number, int bits) {
  int reversed = 0;
  for (int bit = 0; bit < bits; ++bit)
    if (number >> bit & 1) reversed |= 1 << (bits - 1 - bit);
  return reversed;
}

// The destination of each processor in a permutation.
std::vector<int> make_permutation(Pattern pattern, int n) {
  const auto name =
      std::ranges::find(PATTERNS, pattern, &base::Names<Pattern>::value_type::second)->first;
  const bool is_matrix = pattern == Pattern::transpose;
  const int side = is_matrix ? find_side(n) : 0, bits = is_matrix ? 0 : count_bits(name, n);
  std::vector<int> to;
  for (int from = 0; from < n; ++from) {
    if (is_matrix)
      to.push_back(from % side * side + from / side);
    else if (pattern == Pattern::bit_complement)
      to.push_back(n - 1 - from);
    else if (pattern == Pattern::bit_reversal)
      to.push_back(reverse_bits(from, bits));
    else
      to.push_back((from << 1 | from >> (bits - 1)) & (n - 1));
  }
  return to;
}

// For each sender: the weight of each destination, by the destination's number.
using Weights = std::vector<std::map<int, double>>;

class WeightsReader {
 public:
  WeightsReader(const std::string& text, const std::string& name, int processors)
      : csv_(text, name), processors_(processors), weights_(processors) {
    static const std::vector<std::string> COLUMNS{"from", "to", "weight"};
    if (const auto columns = csv_.take_header(); columns != COLUMNS)
      csv_.fail(
          fmt::format("found the columns {}, expected from,to,weight", fmt::join(columns, ",")));
    for (auto row = csv_.take(); !row.empty(); row = csv_.take())
      if (!base::is_blank(row)) add(row);
  }

  const Weights& weights() const { return weights_; }

 private:
  void add(const std::vector<base::CsvCell>& row) {
    if (row.size() != 3) csv_.fail(fmt::format("found {} cells, expected 3", row.size()));
    const int from = read_processor(row[0].text), to = read_processor(row[1].text);
    const auto weight = base::parse_number<double>(row[2].text);
    if (!weight || !(*weight > 0 && *weight <= 1e12))
      csv_.fail(
          fmt::format("weight: found '{}', expected a number above 0, at most 1e12", row[2].text));
    if (from == to) csv_.fail(fmt::format("found {0} to {0}, expected two processors", from));
    if (!weights_[from].emplace(to, *weight).second)
      csv_.fail(fmt::format("found a second row for {} to {}, expected one", from, to));
  }

  int read_processor(const std::string& text) const {
    const auto number = base::parse_number<int>(text);
    if (!number || *number < 0 || *number >= processors_)
      csv_.fail(fmt::format("found '{}', expected the number of a processor, 0 to {}", text,
                            processors_ - 1));
    return *number;
  }

  base::CsvReader csv_;
  int processors_;
  Weights weights_;
};

// Number of messages through each port, at [processor * PORTS + port]. Messages to a neighbour
// count at the lowest port that leads to this neighbour.
using PortLoads = std::vector<double>;

// Adds `messages`, which one sender sends to one destination, to the load of each port on the
// route.
void add_route(PortLoads& loads, const topologies::RoutingTable& routes, int from, int to,
               double messages) {
  while (from != to) {
    const int port = routes.next_port(from, to);
    if (port < 0) return;
    loads[static_cast<std::size_t>(from) * topologies::PORTS + port] += messages;
    from = routes.rule->peers()[from][port];
  }
}

}  // namespace

base::Fields<PatternParams> pattern_fields() {
  using D = base::Declare<PatternParams>;
  return {D::choice("pattern", &PatternParams::pattern, PATTERNS,
                    "rule for the destinations of messages; the bit patterns need a power of two "
                    "of processors, and transpose a square number"),
          D::whole("hot_spot", &PatternParams::hot_spot, 0, 65535, "",
                   "processor that receives more messages than others, with pattern = hot_spot"),
          D::number("hot_share", &PatternParams::hot_share, 0, 1, "",
                    "share of the messages that go to the hot spot"),
          D::file("pattern_file", &PatternParams::file,
                  "CSV with the columns from, to and weight, for pattern = file")};
}

std::string find_void(const PatternParams& params, const std::string& key) {
  const bool is_hot = key.ends_with("hot_spot") || key.ends_with("hot_share");
  if (is_hot && params.pattern != Pattern::hot_spot) return PATTERN;
  if (key.ends_with("pattern_file") && params.pattern != Pattern::file) return PATTERN;
  return "";
}

Destinations::Destinations(const PatternParams& params, const topologies::Topology& topology)
    : processors_(topology.processors), shares_(topology.processors) {
  base::require(processors_ >= 2, "network.topology", "found one processor, expected at least two");
  base::require(params.file.path.empty() || params.pattern == Pattern::file, "program.pattern_file",
                "found a file, expected it only with pattern = \"file\"");
  switch (params.pattern) {
    case Pattern::uniform:
      uniform_ = 1;
      break;
    case Pattern::hot_spot:
      add_hot_spot(params);
      break;
    case Pattern::neighbour:
      add_neighbours(topology);
      break;
    case Pattern::file:
      read_file(params.file);
      break;
    default:
      add_permutation(params.pattern);
  }
}

void Destinations::add_permutation(Pattern pattern) {
  const auto to = make_permutation(pattern, processors_);
  for (int from = 0; from < processors_; ++from)
    if (to[from] != from) shares_[from].push_back({to[from], 1});
}

void Destinations::add_neighbours(const topologies::Topology& topology) {
  const auto around = topologies::neighbours(topology);
  for (int from = 0; from < processors_; ++from) {
    const auto links = static_cast<double>(around[from].size());
    for (std::size_t i = 0; i < around[from].size(); ++i)
      shares_[from].push_back({around[from][i].processor, static_cast<double>(i + 1) / links});
  }
}

// All processors send to the hot spot with the probability hot_share. The hot spot itself sends to
// all other processors with equal probability.
void Destinations::add_hot_spot(const PatternParams& params) {
  base::require(params.hot_spot < processors_, "program.hot_spot",
                "found {}, expected the number of a processor, 0 to {}", params.hot_spot,
                processors_ - 1);
  uniform_ = 1 - params.hot_share;
  for (int from = 0; from < processors_; ++from)
    if (from != params.hot_spot) shares_[from].push_back({params.hot_spot, 1});
  for (int to = 0, count = 0; to < processors_; ++to)
    if (to != params.hot_spot)
      shares_[params.hot_spot].push_back({to, static_cast<double>(++count) / (processors_ - 1)});
}

void Destinations::read_file(const base::Source& file) {
  base::require(!file.path.empty(), "program.pattern_file",
                "found none, expected the file for pattern = \"file\"");
  const auto text = base::read_text(file.path);
  const WeightsReader reader(text, file.path, processors_);
  bool is_empty = true;
  for (int from = 0; from < processors_; ++from) {
    double all = 0, sum = 0;
    for (const auto& [to, weight] : reader.weights()[from]) all += weight;
    for (const auto& [to, weight] : reader.weights()[from])
      shares_[from].push_back({to, (sum += weight) / all});
    is_empty = is_empty && all == 0;
  }
  base::require(!is_empty, file.path, "found no row, expected at least one pair of processors");
}

std::optional<int> Destinations::draw(int from, base::Random& random) const {
  const auto& shares = shares_[from];
  if (uniform_ > 0 && (shares.empty() || uniform_ >= 1 || random.uniform() < uniform_))
    return random.other_than(from, processors_);
  if (shares.empty()) return std::nullopt;
  if (shares.size() == 1) return shares[0].to;
  const auto at = std::ranges::upper_bound(shares, random.uniform(), {}, &Share::until);
  return at == shares.end() ? shares.back().to : at->to;
}

double Destinations::eval_mean_distance(const topologies::RoutingTable& routes) const {
  if (uniform_ >= 1) return routes.mean_distance();
  double sum = 0, senders = 0;
  for (int from = 0; from < processors_; ++from) {
    double before = 0;
    for (const auto& [to, until] : shares_[from])
      sum += (1 - uniform_) * (until - std::exchange(before, until)) * routes.distance(from, to);
    senders += !shares_[from].empty();
  }
  return sum / senders + uniform_ * routes.mean_distance();
}

double Destinations::eval_busiest_link(const topologies::Topology& topology,
                                       const topologies::RoutingTable& routes) const {
  PortLoads loads(static_cast<std::size_t>(processors_) * topologies::PORTS);
  for (int from = 0; from < processors_; ++from) {
    double before = 0;
    for (const auto& [to, until] : shares_[from])
      add_route(loads, routes, from, to, (1 - uniform_) * (until - std::exchange(before, until)));
  }
  // Parallel links share the messages to a neighbour equally.
  const auto parallel = topologies::parallel_ports(topology);
  const auto share = [&](const topologies::End& end) {
    double sum = 0;
    int count = 0;
    for (int port = end.port; count == 0 || port != end.port;
         port = parallel[end.processor][port]) {
      sum += loads[static_cast<std::size_t>(end.processor) * topologies::PORTS + port];
      ++count;
    }
    return sum / count;
  };
  const auto all_pairs = uniform_ > 0 ? topologies::eval_load(topology, routes)
                                      : topologies::Load(topology.links.size());
  double busiest = 0;
  for (std::size_t link = 0; link < topology.links.size(); ++link) {
    const auto& [a, b] = topology.links[link];
    const auto one_way = [&](const topologies::End& end, std::int64_t pairs) {
      return share(end) + uniform_ * static_cast<double>(pairs) / (processors_ - 1);
    };
    busiest = std::max({busiest, one_way(a, all_pairs[link][0]), one_way(b, all_pairs[link][1])});
  }
  return busiest;
}

std::optional<double> Destinations::eval_saturation_load(
    const topologies::Topology& topology, const topologies::RoutingTable& routes) const {
  if (processors_ > 4096) return std::nullopt;
  return 1 / eval_busiest_link(topology, routes);
}

}  // namespace network
