#include "topologies/draw/load_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/errors.hpp"
#include "topologies/draw/graphviz.hpp"
#include "topologies/draw/layout.hpp"

namespace topologies {
namespace {

constexpr double UNIT_PT = 36;       // points per unit of a layout
constexpr double PROCESSOR_PT = 27;  // diameter of a processor in points

struct Colour {
  double r, g, b;
};

// The colours of loads, from low to high. Their lightness decreases (CIE L* 88, 76, 60, 41, 20), so
// that colour-blind readers can distinguish them.
constexpr std::array<Colour, 5> SCALE{
    {{219, 222, 226}, {246, 178, 66}, {229, 110, 60}, {174, 45, 96}, {72, 15, 95}}};

Colour eval_scale(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (SCALE.size() - 1);
  const auto low = std::min(static_cast<size_t>(at), SCALE.size() - 2);
  const auto &a = SCALE[low], &b = SCALE[low + 1];
  const double t = at - static_cast<double>(low);
  return {std::lerp(a.r, b.r, t), std::lerp(a.g, b.g, t), std::lerp(a.b, b.b, t)};
}

const char* text_colour(double share) { return is_dark_load(share) ? "white" : "black"; }

std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share); }

struct Half {  // one direction of a link
  int from, to;
  Place swerve;
  double load;
};

struct Node {
  std::string name, label;
  double load;
  Place place;
};

std::string write_processor(int id, const Node& node, bool is_root, bool is_extra) {
  const double width =
      is_extra ? std::max(64.0, 7.0 * static_cast<double>(node.label.size())) : PROCESSOR_PT;
  const auto longest = static_cast<double>(std::max<size_t>(node.label.size(), 2));
  const double font = is_extra ? 11 : std::min(11.0, 1.5 * PROCESSOR_PT / longest);
  return fmt::format(
      "n{} [class=processor, shape={}, width={:.3f}, height={:.3f}, pos=\"{}\", label={}, "
      "fillcolor=\"{}\", fontcolor={}, fontsize={:.1f}, penwidth={}, tooltip={}];\n",
      id, is_extra ? "box" : "circle", width / 72, PROCESSOR_PT / 72, format_points(node.place),
      quote_dot(node.label), load_colour(node.load), text_colour(node.load), font,
      is_root ? 3 : 0.75, quote_dot(fmt::format("{}: busy {}", node.name, percent(node.load))));
}

// Draws the half of a link next to processor `from`, coloured by the traffic that `from` sends.
std::string write_half(const Half& half, const std::vector<Node>& nodes) {
  const auto& [from, to, swerve, load] = half;
  const auto [p0, p1, p2, p3] = make_half_curve(nodes[from].place, nodes[to].place, swerve);
  return fmt::format(
      "n{} -> n{} [class=link, pos=\"{} {} {} {}\", color=\"{}\", penwidth={:.2f}, tooltip={}];\n",
      from, to, format_points(p0), format_points(p1), format_points(p2), format_points(p3),
      load_colour(load), eval_load_width(load),
      quote_dot(fmt::format("{} to {}: busy {}", nodes[from].name, nodes[to].name, percent(load))));
}

// The index of the extra processor with this name, or the number of extra processors if there is
// none.
size_t find_extra(const Loads& loads, const std::string& name) {
  return static_cast<size_t>(std::ranges::find(loads.extras, name, &Loads::Extra::name) -
                             loads.extras.begin());
}

using base::require;

void check_loads(const Topology& topology, const Loads& loads) {
  constexpr double ROUNDING = 1e-6;
  const auto place = "loads of topology " + topology.name;
  const auto check_share = [&](double share, const auto& what) {
    require(share >= 0 && share <= 1 + ROUNDING, place, "found {} for {}, expected 0 to 1", share,
            what);
  };
  const auto expected = static_cast<size_t>(topology.processors);
  require(loads.processors.size() == expected, place, "found {} processors, expected {}",
          loads.processors.size(), expected);
  require(loads.links.size() == topology.links.size(), place, "found {} links, expected {}",
          loads.links.size(), topology.links.size());
  require(loads.labels.empty() || loads.labels.size() == expected, place,
          "found {} labels, expected {} or none", loads.labels.size(), expected);
  for (size_t p = 0; p < expected; ++p)
    check_share(loads.processors[p], fmt::format("processor {}", p));
  for (size_t i = 0; i < loads.links.size(); ++i)
    for (const double share : loads.links[i]) check_share(share, fmt::format("link {}", i));
  for (size_t i = 0; i < loads.extras.size(); ++i) {
    const auto& [name, load, to, link] = loads.extras[i];
    require(!name.empty() && find_extra(loads, name) == i, place,
            "found an extra processor called \"{}\", expected another name", name);
    require(to.empty() || find_extra(loads, to) < i, place,
            "found \"{}\" wired to \"{}\", expected an earlier extra processor", name, to);
    for (const double share : {load, link[0], link[1]}) check_share(share, name);
  }
}

// Places extra processors in rows above the topology. The row is the number of links between the
// extra processor and the root, counted along extra processors.
std::vector<Place> place_extras(const Loads& loads, const Place& root, double top) {
  std::vector<size_t> row;
  std::vector<int> width, place;
  for (const auto& extra : loads.extras) {
    row.push_back(extra.to.empty() ? 0 : row[find_extra(loads, extra.to)] + 1);
    width.resize(std::max(width.size(), row.back() + 1));
    place.push_back(width[row.back()]++);
  }
  std::vector<Place> places;
  for (size_t i = 0; i < row.size(); ++i)
    places.push_back({root.x + 2.6 * (place[i] - (width[row[i]] - 1) / 2.0),
                      top + 1.6 * static_cast<double>(row[i] + 1)});
  return places;
}

// Draws the colour scale below the drawing; `place` is its left end.
std::string write_legend(const Place& place) {
  constexpr int STEPS = 20;
  constexpr double WIDTH = 0.3, HEIGHT = 0.35;
  constexpr double LETTER = 0.1;  // in inches per letter; Graphviz reserves this room for the text
  const auto text = [&](const char* name, double x, double y, const std::string& words) {
    return fmt::format(
        "{} [class=legend, shape=plaintext, style=solid, label={}, width={:.2f}, height=0.25, "
        "pos=\"{}\"];\n",
        name, quote_dot(words), LETTER * static_cast<double>(words.size()),
        format_points({place.x + x, place.y + y}));
  };
  std::string out;
  for (int i = 0; i < STEPS; ++i)
    out += fmt::format(
        "s{} [class=legend, shape=box, label=\"\", penwidth=0, width={:.4f}, height={:.4f}, "
        "fillcolor=\"{}\", pos=\"{}\"];\n",
        i, WIDTH * UNIT_PT / 72, HEIGHT * UNIT_PT / 72, load_colour((i + 0.5) / STEPS),
        format_points({place.x + (i + 0.5) * WIDTH, place.y}));
  for (int quarter = 0; quarter <= 4; ++quarter)
    out += text(fmt::format("t{}", quarter).c_str(), quarter * STEPS * WIDTH / 4, -0.45,
                fmt::format("{} %", 25 * quarter));
  return out + text("about", STEPS * WIDTH / 2, -0.9,
                    "busy time; half a link next to a processor: what it sends");
}

std::vector<Node> make_nodes(const Topology& topology, const Loads& loads, const Layout& layout) {
  std::vector<Node> nodes;
  for (int p = 0; p < topology.processors; ++p) {
    const auto label = !loads.labels.empty()      ? loads.labels[p]
                       : !topology.labels.empty() ? topology.labels[p]
                                                  : fmt::format("{}", p);
    nodes.push_back({"processor " + label, label, loads.processors[p], layout.processors[p]});
  }
  const double top = std::ranges::max(layout.processors, {}, &Place::y).y;
  const auto places = place_extras(loads, layout.processors[topology.root], top);
  for (size_t i = 0; i < places.size(); ++i)
    nodes.push_back({loads.extras[i].name, loads.extras[i].name, loads.extras[i].load, places[i]});
  return nodes;
}

std::vector<Half> make_halves(const Topology& topology, const Loads& loads, const Layout& layout) {
  std::vector<Half> halves;
  const auto add = [&](int a, int b, const Place& swerve, const std::array<double, 2>& load) {
    halves.push_back({a, b, swerve, load[0]});
    halves.push_back({b, a, swerve, load[1]});
  };
  for (size_t i = 0; i < topology.links.size(); ++i)
    add(topology.links[i].a.processor, topology.links[i].b.processor, layout.swerves[i],
        loads.links[i]);
  for (size_t i = 0; i < loads.extras.size(); ++i) {
    const auto& extra = loads.extras[i];
    const auto to = topology.processors + static_cast<int>(find_extra(loads, extra.to));
    add(static_cast<int>(topology.processors + i), extra.to.empty() ? topology.root : to, {},
        extra.link);
  }
  return halves;
}

// The processors in ascending order of the load of their busiest outgoing link. Graphviz draws
// links in this order, so that busy links cover idle ones.
std::vector<int> make_order(size_t nodes, const std::vector<Half>& halves) {
  std::vector<double> busiest(nodes, 0);
  for (const auto& half : halves) busiest[half.from] = std::max(busiest[half.from], half.load);
  std::vector<int> order(nodes);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int id) { return busiest[id]; });
  return order;
}

}  // namespace

std::string load_colour(double share) {
  const auto [r, g, b] = eval_scale(share);
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(r), std::lround(g), std::lround(b));
}

std::array<double, 3> eval_load_colour(double share) {
  const auto [r, g, b] = eval_scale(share);
  return {std::round(r) / 255, std::round(g) / 255, std::round(b) / 255};
}

bool is_dark_load(double share) {
  const auto [r, g, b] = eval_scale(share);
  return 0.299 * r + 0.587 * g + 0.114 * b < 140;
}

double eval_load_width(double share) { return 1.2 + 5.8 * share; }

std::string to_load_svg(const Topology& topology, const Loads& loads) {
  check_loads(topology, loads);
  const auto layout = make_layout(topology);
  const auto nodes = make_nodes(topology, loads, layout);
  const auto title = quote_dot(loads.title.empty() ? topology.name : loads.title);
  std::string dot = fmt::format(
      "digraph {} {{\nlabel={};\nlabelloc=t;\nfontname=\"sans-serif\";\nfontsize=16;\n"
      "outputorder=edgesfirst;\nnode [style=filled, fixedsize=true, fontname=\"sans-serif\", "
      "fontsize=11, color=\"#333333\"];\nedge [arrowhead=none];\n",
      title, title);
  const auto halves = make_halves(topology, loads, layout);
  for (const int id : make_order(nodes.size(), halves))
    dot += write_processor(id, nodes[id], id == topology.root, id >= topology.processors);
  for (const auto& half : halves) dot += write_half(half, nodes);
  const auto x = std::ranges::minmax(nodes, {}, [](auto& node) { return node.place.x; });
  const auto low = std::ranges::min(nodes, {}, [](auto& node) { return node.place.y; });
  dot += write_legend({(x.min.place.x + x.max.place.x) / 2 - 3, low.place.y - 1.6}) + "}\n";
  return run_graphviz("neato", {"-n2", "-Tsvg"}, dot, topology.name);
}

}  // namespace topologies
