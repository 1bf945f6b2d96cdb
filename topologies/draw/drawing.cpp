#include "topologies/draw/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "topologies/draw/layout.hpp"
#include "topologies/draw/port_places.hpp"
#include "topologies/draw/sheet.hpp"

namespace topologies {
namespace {

std::string name_processor(const Topology& topology, int p) {
  return topology.labels.empty() ? std::to_string(p) : topology.labels[p];
}

std::size_t find_longest_name(const Topology& topology) {
  std::size_t longest = 0;
  for (int p = 0; p < topology.processors; ++p)
    longest = std::max(longest, name_processor(topology, p).size());
  return longest;
}

void draw_links(Sheet& sheet, const Topology& topology, const Layout& layout) {
  const double line = sheet.style().is_figure() ? 0.6 : 1;
  for (std::size_t i = 0; i < topology.links.size(); ++i) {
    const auto& [a, b] = topology.links[i];
    sheet.curve(make_curve(layout.processors[a.processor], layout.processors[b.processor],
                           layout.swerves[i]),
                "#000000", line);
  }
}

void draw_ports(Sheet& sheet, const Topology& topology, const Layout& layout, const Measures& m) {
  const auto places = place_ports(topology, layout, m.port / m.unit, 0.5 * m.processor / m.unit);
  for (std::size_t i = 0; i < topology.links.size(); ++i) {
    const auto& [a, b] = topology.links[i];
    sheet.open("link", fmt::format("{} to {}", name_processor(topology, a.processor),
                                   name_processor(topology, b.processor)));
    sheet.text(sheet.to_points(places[i][0]), std::to_string(a.port), {m.port, "#000000", true});
    sheet.text(sheet.to_points(places[i][1]), std::to_string(b.port), {m.port, "#000000", true});
    sheet.close();
  }
}

void draw_processors(Sheet& sheet, const Topology& topology, const Layout& layout,
                     const Measures& m) {
  const double line = sheet.style().is_figure() ? 0.6 : 1;
  for (int p = 0; p < topology.processors; ++p) {
    const auto at = sheet.to_points(layout.processors[p]);
    const auto name = name_processor(topology, p);
    sheet.open("processor", name);
    if (p == topology.root) sheet.circle(at, 1.25 * m.processor, "#ffffff", line);
    sheet.circle(at, m.processor, "#ffffff", line);
    const auto [shown, size] = fit_name(m, name);
    if (!shown.empty()) sheet.text(at, shown, {size});
    sheet.close();
  }
}

}  // namespace

std::string to_svg(const Topology& topology, const base::FigureStyle& style) {
  constexpr double TITLE = 14;  // font size in points
  const auto layout = make_layout(topology);
  const auto m = choose_measures(layout.processors, find_longest_name(topology), 0, style);
  Sheet sheet(style, m.unit);
  draw_links(sheet, topology, layout);
  draw_ports(sheet, topology, layout, m);
  draw_processors(sheet, topology, layout, m);
  if (!style.is_figure())
    sheet.text({(sheet.low().x + sheet.high().x) / 2, sheet.high().y + TITLE}, topology.name,
               {TITLE});
  return sheet.finish(topology.name);
}

}  // namespace topologies
