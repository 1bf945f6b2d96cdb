#pragma once
// Drawing of a topology with the load of each processor and link.

#include <array>
#include <string>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Loads as shares of the time, 0 to 1.
struct Loads {
  std::string title;
  std::vector<double> processors;            ///< by processor
  std::vector<std::array<double, 2>> links;  ///< by index into Topology::links: a to b, b to a
  std::vector<std::string> labels = {};      ///< by processor; empty: the topology's names

  /// A processor outside the topology, wired to its root or to an earlier extra.
  struct Extra {
    std::string name;
    double load = 0;
    std::string to = {};                  ///< the name of an earlier extra; empty: the root
    std::array<double, 2> link = {0, 0};  ///< load towards `to`, and from there
  };
  std::vector<Extra> extras = {};  ///< with distinct names
};

/// Draws an SVG by Graphviz. Load sets the fill of processors and the colour and width of links;
/// the half of a link next to a processor shows the traffic that this processor sends. The root has
/// a thick rim. Tooltips show the shares; a scale is below. There is one element of class
/// "processor" per processor and extra, and two of class "link" per link. One version of Graphviz
/// gives one result. Throws BadInput if sizes do not match, a load is no share or an extra's `to`
/// is unknown; std::runtime_error if Graphviz is not installed.
std::string to_load_svg(const Topology& topology, const Loads& loads);

/// The colour of a share, "#rrggbb": darkens from light grey at 0 to dark violet at 1.
std::string load_colour(double share);
/// The colour of a share as red, green and blue from 0 to 1; is_dark_load: it needs white text.
std::array<double, 3> eval_load_colour(double share);
bool is_dark_load(double share);
/// The width of a link with this load, in points; processors are 27 points wide.
double eval_load_width(double share);

}  // namespace topologies
