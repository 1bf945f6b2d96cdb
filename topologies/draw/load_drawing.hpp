#pragma once
// Drawing of a topology that shows the load of each processor and link.

#include <array>
#include <string>
#include <vector>

#include "base/figure/figure_style.hpp"
#include "topologies/graph/topology.hpp"

namespace topologies {

/// Loads as fractions of the simulated time, 0 to 1.
struct Loads {
  std::string title;
  std::vector<double> processors;  ///< load of each processor, by number
  /// Load of each link: [0] from a to b, [1] from b to a.
  std::vector<std::array<double, 2>> links;
  /// Names to show in the processors; by default the topology's labels.
  std::vector<std::string> labels = {};

  /// A processor outside the topology, with a link to the root or to an earlier extra processor.
  struct Extra {
    std::string name;
    double load = 0;
    std::string to = {};  ///< name of an earlier extra processor, or "" for the root
    std::array<double, 2> link = {0, 0};  ///< [0] load towards `to`, [1] load from `to`
  };
  std::vector<Extra> extras = {};  ///< names must be distinct
};

/// Draws an SVG. Load determines the fill of processors, and the colour and width of
/// links. Each half of a link shows the traffic sent by the nearer processor. The root has a thick
/// rim. Tooltips show the loads, and a colour scale is below.
///
/// Each processor, and each extra processor, is one element of class "processor"; each link is two
/// elements of class "link".
///
/// Throws BadInput if sizes do not match, a load is not in [0, 1] or an extra's `to` is unknown.
/// Throws as make_layout() does.
std::string to_load_svg(const Topology& topology, const Loads& loads,
                        const base::FigureStyle& style = {});

/// The colour of a load as "#rrggbb", from light grey at 0 to dark violet at 1.
std::string load_colour(double share);
/// The colour of a load as red, green and blue, each from 0 to 1. is_dark_load returns true if text
/// on this colour must be white to be legible.
std::array<double, 3> eval_load_colour(double share);
bool is_dark_load(double share);
/// The width in points of a link with this load. For comparison, processors have a diameter of 27
/// points.
double eval_load_width(double share);

}  // namespace topologies
