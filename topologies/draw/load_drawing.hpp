#pragma once
// A topology drawn with how busy each processor and link was.

#include <array>
#include <string>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// How busy everything was: shares of the time, 0 to 1.
struct Loads {
  std::string title;
  std::vector<double> processors;            ///< by processor
  std::vector<std::array<double, 2>> links;  ///< by index into Topology::links: a to b, b to a
  std::vector<std::string> labels = {};      ///< in the processors; empty: what Topology calls them

  /// A processor outside the topology, wired to its root or to an earlier one of these.
  struct Extra {
    std::string name;
    double load = 0;
    std::string to = {};                  ///< the name of an earlier one; empty: the root
    std::array<double, 2> link = {0, 0};  ///< towards `to`, and from there
  };
  std::vector<Extra> extras = {};  ///< names differ
};

/// Draws an SVG by Graphviz: processors filled by load, the root with a thick rim; links coloured
/// and thickened by load, the half next to a processor for what it sends; a scale; the shares as
/// tooltips. There is one element of class "processor" per processor and extra, and two of class
/// "link" per link. The result is the same for a version of Graphviz. Throws BadInput when sizes do
/// not match, a load is no share or an extra's `to` is unknown, std::runtime_error when Graphviz is
/// not installed.
std::string to_load_svg(const Topology& topology, const Loads& loads);

/// The colour of a share, "#rrggbb": from a light grey at 0 to a dark violet at 1, ever darker.
std::string load_colour(double share);
/// The same as red, green and blue from 0 to 1; and whether text on it is to be white.
std::array<double, 3> eval_load_colour(double share);
bool is_dark_load(double share);
/// Width of a link that is busy for a share of the time, in points where processors are 27 wide.
double eval_load_width(double share);

}  // namespace topologies
