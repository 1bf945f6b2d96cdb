#include "topologies/draw/drawing.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "topologies/draw/graphviz.hpp"
#include "topologies/draw/layout.hpp"

namespace topologies {
namespace {

using Curve = std::array<Place, 4>;

// The position of the port number at the first end of a link: beside the link, just outside the
// processor. Given positions save minutes for large networks, because Graphviz would otherwise
// search for free places.
Place place_port(const Curve& curve) {
  constexpr double ALONG = 0.6, ASIDE = 0.16;
  const auto at_quarter = [&](double Place::*axis) {  // the point at parameter t = 1/4 of the curve
    return (27 * curve[0].*axis + 27 * curve[1].*axis + 9 * curve[2].*axis + curve[3].*axis) / 64;
  };
  const Place from = curve[0];
  const double dx = at_quarter(&Place::x) - from.x, dy = at_quarter(&Place::y) - from.y;
  const double length = std::hypot(dx, dy), x = dx / length, y = dy / length;
  return {from.x + ALONG * x - ASIDE * y, from.y + ALONG * y + ASIDE * x};
}

std::string draw_link(const Link& link, const Curve& curve) {
  const auto& [a, b] = link;
  const Curve back{curve[3], curve[2], curve[1], curve[0]};
  return fmt::format(
      "{} -- {} [pos=\"{} {} {} {}\", taillabel={}, tail_lp=\"{}\", headlabel={}, "
      "head_lp=\"{}\"];\n",
      a.processor, b.processor, format_points(curve[0]), format_points(curve[1]),
      format_points(curve[2]), format_points(curve[3]), a.port, format_points(place_port(curve)),
      b.port, format_points(place_port(back)));
}

}  // namespace

std::string to_svg(const Topology& topology) {
  const auto layout = make_layout(topology);
  std::string dot = fmt::format(
      "graph {{\nlabel={};\noutputorder=edgesfirst;\nnode [shape=circle, style=filled, "
      "fillcolor=white, width=0.375, fixedsize=shape, fontsize=11];\n"
      "edge [fontsize=8];\n",
      quote_dot(topology.name));
  for (int p = 0; p < topology.processors; ++p)
    dot += fmt::format("{} [label={}, peripheries={}, pos=\"{}\"];\n", p,
                       quote_dot(topology.labels.empty() ? std::to_string(p) : topology.labels[p]),
                       p == topology.root ? 2 : 1, format_points(layout.processors[p]));
  for (std::size_t i = 0; i < topology.links.size(); ++i) {
    const auto& link = topology.links[i];
    dot += draw_link(link, make_curve(layout.processors[link.a.processor],
                                      layout.processors[link.b.processor], layout.swerves[i]));
  }
  return run_graphviz("neato", {"-n2", "-Tsvg"}, dot + "}\n", topology.name);
}

}  // namespace topologies
