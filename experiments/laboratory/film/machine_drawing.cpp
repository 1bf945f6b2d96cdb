#include "experiments/laboratory/film/machine_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "experiments/laboratory/places/places.hpp"
#include "topologies/draw/load_drawing.hpp"

namespace laboratory {

using topologies::Place;
using topologies::Places;
using topologies::Topology;

namespace {

// Sizes in pixels. A `unit` is the length in pixels of 1 in the layout, where the closest
// processors are 1 apart.
constexpr double LEGEND_HEIGHT = 62, MOST_UNIT = 56;
constexpr double WIDTH = 1200, HEIGHT = 720, LEAST_WIDTH = 640;
// A unit is at least SMALL_UNIT pixels, unless a side of the frame would then exceed MOST_SIDE.
constexpr double SMALL_UNIT = 8, MOST_SIDE = 2400;
constexpr double BOX_HEIGHT = 26, BOX_FONT = 12, SMALLEST_FONT = 6.5, BESIDE_FONT = 10;
constexpr double DIAMETER = 0.75;  // diameter of a processor, in units
// Height of the rows and width of the columns in which processors above the network are drawn. They
// are ROW_UNITS and COLUMN_UNITS units, but at least ROW and COLUMN pixels.
constexpr double ROW_UNITS = 1.6, ROW = 46, COLUMN_UNITS = 2.6, COLUMN = 120;

struct Bounds {
  Place low, high;
  double width() const { return high.x - low.x; }
  double height() const { return high.y - low.y; }
};

Bounds find_bounds(const Places& places) {
  const auto x = std::ranges::minmax(places, {}, &Place::x);
  const auto y = std::ranges::minmax(places, {}, &Place::y);
  return {{x.min.x, y.min.y}, {x.max.x, y.max.y}};
}

double choose_unit(const Bounds& bounds) {
  const double width = bounds.width() + 2, height = bounds.height() + 2;
  const double unit = std::min({WIDTH / width, HEIGHT / height, MOST_UNIT});
  return std::max(unit, std::min({SMALL_UNIT, MOST_SIDE / width, MOST_SIDE / height}));
}

std::size_t index(int id) { return static_cast<std::size_t>(id); }

// Arranges processors outside the network in rows above the network's root, by their distance from
// the root.
std::vector<std::vector<int>> find_rows(const machine::Machine& machine, int root,
                                        const SomePlaces& placed) {
  std::vector<std::vector<int>> rows{{root}};
  std::vector<bool> known(placed.size());
  while (!rows.back().empty()) {
    std::vector<int> next;
    for (const int from : rows.back())
      for (const auto& link : machine.links()) {
        const int to = link->to().id();
        if (link->from().id() != from || placed[index(to)] || known[index(to)]) continue;
        known[index(to)] = true;
        next.push_back(to);
      }
    rows.push_back(std::move(next));
  }
  rows.erase(rows.begin());
  rows.pop_back();
  return rows;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The number at the end of a processor's name, such as 12 for "worker12"; or the whole name if it
// has no such number.
std::string number_of(const std::string& name) {
  std::size_t begin = name.size();
  while (begin > 0 && is_digit(name[begin - 1])) --begin;
  const bool is_word = std::ranges::none_of(name.substr(0, begin), is_digit);
  return begin < name.size() && is_word ? name.substr(begin) : name;
}

// Groups `swerves` by the machine ids of the two processors of a link. A swerve is the offset of a
// link's midpoint from the straight line. Several links between two processors keep their order.
std::map<std::pair<int, int>, std::vector<Place>> sort_swerves(const Topology& topology,
                                                               const Places& swerves,
                                                               const std::vector<int>& network) {
  std::map<std::pair<int, int>, std::vector<Place>> sorted;
  for (std::size_t i = 0; i < swerves.size(); ++i) {
    const int a = find_id(network, topology.links[i].a.processor);
    const int b = find_id(network, topology.links[i].b.processor);
    sorted[std::minmax(a, b)].push_back(swerves[i]);
  }
  return sorted;
}

}  // namespace

MachineDrawing::MachineDrawing(const machine::Machine& machine, const Topology& topology,
                               const std::vector<int>& network) {
  const auto layout = topologies::make_layout(topology);
  SomePlaces some(machine.processors().size());
  for (int p = 0; p < topology.processors; ++p)
    some.at(index(find_id(network, p))) = layout.processors[index(p)];
  nodes_.resize(some.size());
  for (std::size_t i = 0; i < some.size(); ++i) {
    const auto& name = machine.processors()[i]->name();
    nodes_[i].label = topology.labels.empty() ? number_of(name) : name;
    nodes_[i].is_box = !some[i];
  }
  const int root = find_id(network, topology.root);
  nodes_[index(root)].is_root = true;

  const auto bounds = find_bounds(layout.processors);
  unit_ = choose_unit(bounds);
  radius_ = DIAMETER * unit_ / 2;
  const auto rows = find_rows(machine, root, some);
  const double row = std::max(ROW_UNITS, ROW / unit_);
  const double column = std::max(COLUMN_UNITS, COLUMN / unit_);
  const double root_x = some[index(root)]->x;
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t i = 0; i < rows[r].size(); ++i) {
      auto& node = nodes_[index(rows[r][i])];
      node.label = machine.processors()[index(rows[r][i])]->name();
      const double from_middle =
          static_cast<double>(i) - static_cast<double>(rows[r].size() - 1) / 2;
      some[index(rows[r][i])] = {root_x + column * from_middle,
                                 bounds.high.y + row * static_cast<double>(r + 1)};
    }
  for (std::size_t i = 0; i < some.size(); ++i)
    // processors outside the rows are circles, because boxes would overlap their neighbours
    if (!some[i]) nodes_[i].is_box = false;
  place(place_others(machine, std::move(some)));
  join(machine, sort_swerves(topology, layout.swerves, network));
}

// Converts the layout (y upwards, in units) to pixels (y downwards), centred in the frame.
void MachineDrawing::place(const Places& places) {
  const auto bounds = find_bounds(places);
  double wide = radius_;
  for (const auto& node : nodes_)
    if (node.is_box) wide = std::max(wide, box_width(node) / 2);
  width_ = static_cast<int>(
      std::ceil(std::max(LEAST_WIDTH, unit_ * (bounds.width() + 1) + 2 * (wide + FRAME_MARGIN))));
  height_ =
      static_cast<int>(std::ceil(TITLE_HEIGHT + unit_ * (bounds.height() + 1) + 2 * FRAME_MARGIN +
                                 2 * radius_ + LEGEND_HEIGHT + TIME_SCALE_HEIGHT));
  const double left = (width_ - unit_ * bounds.width()) / 2;
  const double top = TITLE_HEIGHT + FRAME_MARGIN + radius_ + unit_ / 2;
  for (std::size_t i = 0; i < places.size(); ++i)
    nodes_[i].place = {left + unit_ * (places[i].x - bounds.low.x),
                       top + unit_ * (bounds.high.y - places[i].y)};
}

void MachineDrawing::join(const machine::Machine& machine, const Swerves& swerves) {
  std::map<std::pair<int, int>, std::size_t> used;
  for (const auto& link : machine.links()) {
    const int from = link->from().id(), to = link->to().id();
    const auto found = swerves.find(std::minmax(from, to));
    const auto number = used[{from, to}]++;
    Place swerve;
    if (found != swerves.end() && number < found->second.size()) swerve = found->second[number];
    halves_.push_back(topologies::make_half_curve(
        nodes_[index(from)].place, nodes_[index(to)].place, {unit_ * swerve.x, -unit_ * swerve.y}));
  }
}

double MachineDrawing::box_width(const Node& node) {
  return std::max(64.0, text_width(node.label, BOX_FONT) + 16);
}

renderer::Bitmap MachineDrawing::draw(const std::string& title, const Busy& busy, const Span& film,
                                      const Span& now) const {
  Canvas canvas(width_, height_);
  draw_title(canvas, title);
  // Draws the busiest link halves last, so that they lie above idle ones.
  std::vector<std::size_t> order(halves_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return busy.links[i]; });
  const double thinner = std::min(1.2, radius_ / 13.5);
  for (const auto i : order)
    canvas.curve(halves_[i], topologies::eval_load_colour(busy.links[i]),
                 std::max(0.7, thinner * topologies::eval_load_width(busy.links[i])));
  for (std::size_t i = 0; i < nodes_.size(); ++i) draw_node(canvas, nodes_[i], busy.processors[i]);
  draw_legend(canvas, now.length_s());
  draw_time_scale(canvas, film, now);
  return canvas.bitmap();
}

void MachineDrawing::draw_node(Canvas& canvas, const Node& node, double busy) const {
  const auto [x, y] = node.place;
  const auto fill = topologies::eval_load_colour(busy);
  const auto ink = topologies::is_dark_load(busy) ? WHITE : INK;
  const double rim = node.is_root ? 2.5 : 0.75;
  if (node.is_box) {
    const double width = box_width(node);
    const Rectangle box{x - width / 2, y - BOX_HEIGHT / 2, width, BOX_HEIGHT};
    canvas.fill(box, fill);
    canvas.outline(box, INK, rim);
    return canvas.text(x, y + 0.36 * BOX_FONT, node.label, BOX_FONT, Align::middle, ink);
  }
  canvas.disc(node.place, radius_, fill);
  canvas.ring(node.place, radius_, INK, std::min(rim, radius_ / 4));
  const double inside = 1.75 * radius_;  // width available for the label
  const double size = std::min(13.0, inside / std::max(text_width(node.label, 1), 1.2));
  if (size >= SMALLEST_FONT)
    canvas.text(x, y + 0.36 * size, node.label, size, Align::middle, ink);
  else if (text_width(node.label, BESIDE_FONT) < 1.9 * unit_)
    canvas.text_on_lines(x, y + radius_ + BESIDE_FONT + 1, node.label, BESIDE_FONT, Align::middle);
}

void MachineDrawing::draw_legend(Canvas& canvas, double window_s) const {
  constexpr int STEPS = 50;
  constexpr double BAR_WIDTH = 200, BAR_HEIGHT = 12;
  const double y = canvas.height() - TIME_SCALE_HEIGHT - LEGEND_HEIGHT + 6;
  for (int i = 0; i < STEPS; ++i)
    canvas.fill({FRAME_MARGIN + i * BAR_WIDTH / STEPS, y, BAR_WIDTH / STEPS, BAR_HEIGHT},
                topologies::eval_load_colour((i + 0.5) / STEPS));
  for (const int percent : {0, 25, 50, 75, 100})
    canvas.text(FRAME_MARGIN + percent * BAR_WIDTH / 100, y + BAR_HEIGHT + 14,
                fmt::format("{} %", percent), 11, percent == 0 ? Align::left : Align::middle,
                FAINT);
  const double x = FRAME_MARGIN + BAR_WIDTH + 36;
  canvas.text(x, y + 10, fmt::format("busy time in the last {}", format_time(window_s, window_s)),
              12);
  canvas.text(x, y + 26, "half a link next to a processor: what it sends", 12);
}

}  // namespace laboratory
