#pragma once
// A machine's wiring: processors, their four link ports, and the links between ports.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace topologies {

constexpr int PORTS = 4;                          ///< links of a transputer
constexpr int MAX_PROCESSORS = 65536;             ///< limit of a machine
constexpr std::size_t MAX_FILE_BYTES = 16 << 20;  ///< limit of a file of a network or of routes

struct End {
  int processor;
  int port;
  bool operator==(const End&) const = default;
};

struct Link {
  End a, b;  ///< a.processor < b.processor
  bool operator==(const Link&) const = default;
};

/// The arrangement that a generator gave its processors, for drawings and tables.
struct Shape {
  enum class Form { unknown, line, ring, grid, hypercube, around_root };
  Form form = Form::unknown;
  int rows = 0, columns = 0;  ///< size of a grid, numbered row by row; else 0
};

struct Topology {
  std::string name;  ///< its spec, such as "tree:7", or the path of its file
  int processors = 0;
  int root = 0;                        ///< the processor nearest to the host
  std::vector<Link> links;             ///< sorted by (a.processor, b.processor, a.port)
  std::optional<int> bisection_width;  ///< links; from the generator's closed form, if known
  std::vector<std::string> labels;     ///< by processor; empty if processors only have numbers
  /// Number of C004 link switches on each link, keyed by its two processors, lower first; other
  /// links have none.
  std::map<std::pair<int, int>, int> switches = {};
  Shape shape = {};         ///< unknown for a topology from a file
  bool has_arrows = false;  ///< its file holds a directed graph; links still go both ways
};

/// True if a connected topology has no cycles.
inline bool is_tree(const Topology& topology) {
  return static_cast<int>(topology.links.size()) == topology.processors - 1;
}

/// Throws BadInput that names the first violation. Requires 1..MAX_PROCESSORS processors with the
/// root among them, at most PORTS links a processor and one link a port. Links must be sorted, none
/// may join a processor to itself, and they must connect all processors.
void check(const Topology& topology);

struct Neighbour {
  int port;       ///< on this side
  int processor;  ///< on the other side
  int its_port;   ///< on the other side
  int link;       ///< index into Topology::links
};

/// The neighbours of each processor, by ascending port.
std::vector<std::vector<Neighbour>> neighbours(const Topology& topology);

/// Sorts the links into the order of Topology::links.
void sort_links(Topology& topology);

/// The links with one of several parallel ones: the one on the lowest port of a.
std::vector<Link> distinct_links(const Topology& topology);

/// For each processor and port: the next port to the same neighbour, in cyclic order. It is the
/// port itself if there is no other one, or no link.
std::vector<std::array<std::int8_t, PORTS>> parallel_ports(const Topology& topology);

/// For each processor and port: the neighbour, or the processor itself without a link.
using Peers = std::vector<std::array<int, PORTS>>;
Peers make_peers(const Topology& topology);

/// The number of C004 link switches between two neighbours, given in any order.
int switches_between(const Topology& topology, int a, int b);

/// The lowest port of `processor` without a link; -1 if all four have one.
int free_port(const Topology& topology, int processor);

/// The name of `processor` in tables and drawings: its label, or `otherwise` without labels.
std::string name_of(const Topology& topology, int processor, std::string otherwise);

/// The name of `processor` in messages: its label in quotes, or its number.
std::string describe_processor(const Topology& topology, int processor);

}  // namespace topologies
