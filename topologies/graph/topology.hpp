#pragma once
// The wiring of a machine: processors with four link ports each, and links between ports.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace topologies {

constexpr int PORTS = 4;                          ///< number of links of a transputer
constexpr int MAX_PROCESSORS = 65536;             ///< maximum size of a machine
constexpr std::size_t MAX_FILE_BYTES = 16 << 20;  ///< largest file of a topology or of routes

struct End {
  int processor;
  int port;
  bool operator==(const End&) const = default;
};

struct Link {
  End a, b;  ///< the two ends; a.processor < b.processor
  bool operator==(const Link&) const = default;
};

/// The regular arrangement of processors in a generated topology, for drawings and tables.
struct Shape {
  enum class Form { unknown, line, ring, grid, hypercube, around_root };
  Form form = Form::unknown;
  /// Numbers of rows and columns of a grid, whose processors are numbered row by row; 0 for any
  /// other form.
  int rows = 0, columns = 0;
};

struct Topology {
  std::string name;  ///< specification of the topology, such as "tree:7", or the path of its file
  int processors = 0;
  int root = 0;                        ///< the processor nearest to the host computer
  std::vector<Link> links;             ///< sorted by (a.processor, b.processor, a.port)
  std::optional<int> bisection_width;  ///< in links; set only by generators that know a formula
  std::vector<std::string> labels;     ///< names of the processors, by number; may be empty
  /// Number of C004 link switches (crossbar chips) on a link, by the link's two processors, lower
  /// number first. A link without an entry has no switch.
  std::map<std::pair<int, int>, int> switches = {};
  Shape shape = {};             ///< unknown for a topology that was read from a file
  bool has_arrows = false;      ///< the topology was read from a file with a directed graph
  bool has_port_names = false;  ///< the file has port names that are not numbers; they are ignored
};

/// True if the topology, which must be connected, has no cycles.
inline bool is_tree(const Topology& topology) {
  return static_cast<int>(topology.links.size()) == topology.processors - 1;
}

/// Throws BadInput that names the first violation of these rules: There are 1 to MAX_PROCESSORS
/// processors. The root is one of them. A processor has at most PORTS links, and a port has at most
/// one link. Links are sorted, join distinct processors and connect all processors.
void check(const Topology& topology);

struct Neighbour {
  int port;       ///< port of this processor that leads to the neighbour
  int processor;  ///< number of the neighbour
  int its_port;   ///< port of the neighbour that leads back
  int link;       ///< index into Topology::links
};

/// Lists the neighbours of each processor, by ascending port.
std::vector<std::vector<Neighbour>> neighbours(const Topology& topology);

/// Sorts the links into the order of Topology::links.
void sort_links(Topology& topology);

/// The links without parallel ones. If several links join the same two processors, the one on the
/// lowest port of the lower-numbered processor remains.
std::vector<Link> distinct_links(const Topology& topology);

/// For each processor and port: the next port that leads to the same neighbour, in cyclic order. A
/// port without a parallel link, or without any link, leads to itself.
std::vector<std::array<std::int8_t, PORTS>> parallel_ports(const Topology& topology);

/// For each processor and port: the neighbour, or the processor itself if the port has no link.
using Peers = std::vector<std::array<int, PORTS>>;
Peers make_peers(const Topology& topology);

/// The number of C004 link switches on the link between two neighbours, given in either order.
int switches_between(const Topology& topology, int a, int b);

/// The lowest port of `processor` without a link; -1 if all four ports have links.
int free_port(const Topology& topology, int processor);

/// The name of `processor` in tables and drawings: its label, or `otherwise` if the topology has no
/// labels.
std::string name_of(const Topology& topology, int processor, std::string otherwise);

/// The name of `processor` in messages: its label in quotes, or its number if it has no label.
std::string describe_processor(const Topology& topology, int processor);

}  // namespace topologies
