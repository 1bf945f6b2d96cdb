#pragma once
// A machine's wiring: processors, their four link ports, and which port is wired to which.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace topologies {

constexpr int PORTS = 4;                          ///< links of a transputer
constexpr int MAX_PROCESSORS = 65536;             ///< of a machine
constexpr std::size_t MAX_FILE_BYTES = 16 << 20;  ///< of a file of a network or of routes

struct End {
  int processor;
  int port;
  bool operator==(const End&) const = default;
};

struct Link {
  End a, b;  ///< a.processor < b.processor
  bool operator==(const Link&) const = default;
};

/// The form that a generator gave to its processors, for drawings and tables.
struct Shape {
  enum class Form { unknown, line, ring, grid, hypercube, around_root };
  Form form = Form::unknown;
  int rows = 0, columns = 0;  ///< of a grid, numbered row by row; else 0
};

struct Topology {
  std::string name;  ///< the spec it was made from, e.g. "tree:7", or the path of its file
  int processors = 0;
  int root = 0;                        ///< the processor nearest to the host
  std::vector<Link> links;             ///< sorted by (a.processor, b.processor, a.port)
  std::optional<int> bisection_width;  ///< links; the generator's closed form, where one is known
  std::vector<std::string> labels;     ///< per processor; empty when they are called by number
  /// Number of C004 link switches on each link, keyed by its two processors, lower first; links not
  /// listed have none.
  std::map<std::pair<int, int>, int> switches = {};
  Shape shape = {};         ///< unknown for a topology from a file
  bool has_arrows = false;  ///< its file is of a directed graph; links go both ways all the same
};

/// True if the wiring has no cycles; it must be connected.
inline bool is_tree(const Topology& topology) {
  return static_cast<int>(topology.links.size()) == topology.processors - 1;
}

/// Throws BadInput, naming the culprit, unless: there are 1..MAX_PROCESSORS processors, the root is
/// one of them, no processor has more than PORTS links, every port has at most one, no link joins a
/// processor to itself, links are sorted, all processors are connected.
void check(const Topology& topology);

struct Neighbour {
  int port;       ///< on this side
  int processor;  ///< on the other side
  int its_port;   ///< on the other side
  int link;       ///< index into Topology::links
};

/// For each processor its neighbours, by ascending port.
std::vector<std::vector<Neighbour>> neighbours(const Topology& topology);

/// Brings the links into their order.
void sort_links(Topology& topology);

/// The links, but one where several join the same two processors: that of the lowest port of a.
std::vector<Link> distinct_links(const Topology& topology);

/// For each processor and port the next higher of its ports that lead to the same neighbour, after
/// the highest the lowest; without such a port, and where no link is, the port itself.
std::vector<std::array<std::int8_t, PORTS>> parallel_ports(const Topology& topology);

/// For each processor and port the neighbour; where no link is, the processor itself.
using Peers = std::vector<std::array<int, PORTS>>;
Peers make_peers(const Topology& topology);

/// The number of C004 link switches between two neighbours, in any order.
int switches_between(const Topology& topology, int a, int b);

/// The lowest port of `processor` that no link uses, or -1 when all four are taken.
int free_port(const Topology& topology, int processor);

/// What tables and drawings call `processor`: its label, where there are labels, else `otherwise`.
std::string name_of(const Topology& topology, int processor, std::string otherwise);

/// What a message calls `processor`: its label in quotes or its number.
std::string describe_processor(const Topology& topology, int processor);

}  // namespace topologies
