#pragma once
// Drawing of a topology with the load of each processor and link.

#include <array>
#include <string>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Loads as fractions of time, 0 to 1.
struct Loads {
  std::string title;
  std::vector<double> processors;            ///< loads, by processor
  std::vector<std::array<double, 2>> links;  ///< by link: from a to b, from b to a
  std::vector<std::string> labels = {};      ///< by processor; default: the topology's

  /// A processor outside the topology, linked to the root or to an earlier extra processor.
  struct Extra {
    std::string name;
    double load = 0;
    std::string to = {};                  ///< name of an earlier extra; "": the root
    std::array<double, 2> link = {0, 0};  ///< load towards `to`, and load from `to`
  };
  std::vector<Extra> extras = {};  ///< names must be distinct
};

/// Draws an SVG by Graphviz. Load determines the fill of processors, and the colour and width of
/// links. Each half of a link shows the traffic sent by the nearer processor. The root has a thick
/// rim. Tooltips show the loads, and a colour scale is below.
///
/// Each processor, and each extra processor, is one element of class "processor"; each link is two
/// elements of class "link". The bytes depend only on the version of Graphviz.
///
/// Throws BadInput if sizes do not match, a load is not in [0, 1] or an extra's `to` is unknown.
/// Throws std::runtime_error if Graphviz is not installed.
std::string to_load_svg(const Topology& topology, const Loads& loads);

/// The colour of a load as "#rrggbb", from light grey at 0 to dark violet at 1.
std::string load_colour(double share);
/// The colour of a load as red, green and blue from 0 to 1. is_dark_load returns true if text on
/// that colour must be white.
std::array<double, 3> eval_load_colour(double share);
bool is_dark_load(double share);
/// The width in points of a link with this load. For comparison, processors are 27 points wide.
double eval_load_width(double share);

}  // namespace topologies
