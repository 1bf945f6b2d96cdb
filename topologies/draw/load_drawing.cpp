#include "topologies/draw/load_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/errors.hpp"
#include "topologies/draw/layout.hpp"
#include "topologies/draw/sheet.hpp"

namespace topologies {
namespace {

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

const char* text_colour(double share) { return is_dark_load(share) ? "#ffffff" : "#000000"; }

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

std::string tell_busy(const std::string& name, double load) {
  return fmt::format("{}: busy {}", name, percent(load));
}

double box_width(const std::string& label, const Measures& m) {
  return std::max(64.0 / 11 * m.font, Sheet::width_of(label, m.font) + m.font);
}

void draw_processor(Sheet& sheet, const Node& node, const Measures& m, bool is_root,
                    bool is_extra) {
  const auto at = sheet.to_points(node.place);
  const double line = (is_root ? 3 : 0.75) * m.font / 11;
  const auto [shown, size] = is_extra ? FittedName{node.label, m.font} : fit_name(m, node.label);
  sheet.open("processor", tell_busy(node.name, node.load));
  if (is_extra)
    sheet.box(at, box_width(node.label, m), m.processor, load_colour(node.load), line);
  else
    sheet.circle(at, m.processor, load_colour(node.load), line);
  if (!shown.empty()) sheet.text(at, shown, {size, text_colour(node.load)});
  sheet.close();
}

// Draws the half of a link that is next to `from`. It shows the traffic sent by `from`.
void draw_half(Sheet& sheet, const Half& half, const std::vector<Node>& nodes, const Measures& m) {
  const auto& [from, to, swerve, load] = half;
  sheet.open("link", tell_busy(fmt::format("{} to {}", nodes[from].name, nodes[to].name), load));
  sheet.curve(make_half_curve(nodes[from].place, nodes[to].place, swerve), load_colour(load),
              eval_load_width(load) * m.processor / 27);
  sheet.close();
}

// The index in `extras` of the extra processor called `name`; the size of `extras` if there is no
// such processor.
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

// Places extra processors, which are outside the topology, in rows above it. The first row has the
// extra processors with a link to the root. Each further row has the extra processors with a link
// to the row before.
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

// Draws the colour scale below the drawing.
void draw_legend(Sheet& sheet, const Measures& m) {
  constexpr int STEPS = 20;
  const double middle = (sheet.low().x + sheet.high().x) / 2, top = sheet.high().y + 2 * m.font;
  const double step = m.font, width = STEPS * step;
  sheet.open("legend", "");
  for (int i = 0; i < STEPS; ++i)
    sheet.box({middle - width / 2 + (i + 0.5) * step, top}, 1.02 * step, 1.2 * m.font,
              load_colour((i + 0.5) / STEPS), 0);
  for (int quarter = 0; quarter <= 4; ++quarter)
    sheet.text({middle + (quarter / 4.0 - 0.5) * width, top + 1.5 * m.font},
               fmt::format("{} %", 25 * quarter), {m.font});
  for (const auto* words : {"busy time; half a link next to a", "processor: what it sends"})
    sheet.text({middle, sheet.high().y + 0.9 * m.font}, words, {m.font});
  sheet.close();
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

// Orders processors by the load of their busiest outgoing link, ascending. Links are drawn in this
// order, so that busy ones cover idle ones.
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

std::string to_load_svg(const Topology& topology, const Loads& loads,
                        const base::FigureStyle& style) {
  constexpr double TITLE = 16;  // font size in points
  check_loads(topology, loads);
  const auto layout = make_layout(topology);
  const auto nodes = make_nodes(topology, loads, layout);
  Places places;
  std::size_t longest = 0;
  for (const auto& node : nodes) {
    places.push_back(node.place);
    longest = std::max(longest, node.label.size());
  }
  const double outside = loads.extras.empty() ? 0 : 64.0 / 11 * style.font_pt;
  const auto m = choose_measures(places, longest, outside, style);
  Sheet sheet(style, m.unit);
  const auto halves = make_halves(topology, loads, layout);
  const auto order = make_order(nodes.size(), halves);
  std::vector<std::vector<const Half*>> halves_of(nodes.size());
  for (const auto& half : halves) halves_of[static_cast<size_t>(half.from)].push_back(&half);
  for (const int id : order)
    for (const auto* half : halves_of[static_cast<size_t>(id)]) draw_half(sheet, *half, nodes, m);
  for (const int id : order)
    draw_processor(sheet, nodes[static_cast<size_t>(id)], m, id == topology.root,
                   id >= topology.processors);
  draw_legend(sheet, m);
  const auto& title = loads.title.empty() ? topology.name : loads.title;
  if (!style.is_figure())
    sheet.text({(sheet.low().x + sheet.high().x) / 2, sheet.low().y - TITLE}, title, {TITLE});
  return sheet.finish(title);
}

}  // namespace topologies
