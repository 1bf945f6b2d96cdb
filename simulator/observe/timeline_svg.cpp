// Draws a timeline as an SVG, 1600 pixels wide or of a figure's size: names on the left,
// percentages of time on the right, one column per pixel.

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/text.hpp"
#include "simulator/observe/ticks.hpp"
#include "simulator/observe/timeline.hpp"
#include "simulator/observe/trace_output.hpp"

namespace observe {

namespace {

constexpr std::size_t MOST_PROCESSORS = 64;
constexpr double LINE = 16;            // height of a line of text, for a font of 12
constexpr double ARROWS = 90;          // width of the margin with the arrows of a cycle of waits
constexpr std::size_t MOST_TOLD = 24;  // maximum number of waiting processes listed below the chart
constexpr auto FAULT = "#b40000";
constexpr auto LOW = "#9ecae1", HIGH = "#e6550d", SWITCHING = "#3b3b3b", MESSAGE = "#41ab5d";

// Heights of rows.
struct Heights {
  double cpu, link, gap;
};

Heights choose_heights(std::size_t processors) {
  if (processors <= 16) return {26, 10, 8};
  if (processors <= 32) return {14, 5, 5};
  return {9, 3, 3};
}

bool is_first_byte(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

// Number of characters in a UTF-8 text.
std::size_t length_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, is_first_byte));
}

std::string shorten(const std::string& text, std::size_t length) {
  if (length_of(text) <= length) return text;
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size(); ++end)
    if (is_first_byte(text[end]) && ++characters == length) break;
  return text.substr(0, end) + "…";
}

// Rounds a length to hundredths, so that numbers are short.
double to_hundredths(double length) { return std::round(100 * length) / 100; }

// Lengths of a chart: pixels on the screen, points in a figure.
struct ChartSize {
  double left = 150, width = 1380, right = 70;  // widths of names, time axis, percentages
  double arrows = 0;                            // margin for the arrows of a cycle of waits
  double scale = 1;                             // relative to a font of 12 pixels
  std::size_t columns = 1380;

  double sum() const { return left + width + right + arrows; }
};

// In a figure, the widths of the columns beside the time axis follow from the longest texts in
// these columns.
ChartSize choose_size(const Trace& trace, std::size_t shown, const base::FigureStyle& style) {
  ChartSize size;
  if (trace.cycle > 0) size.arrows = ARROWS;
  if (!style.is_figure()) return size;
  constexpr double LETTER = 0.6;       // mean width of a letter for a font size of 1
  constexpr double PER_POINT = 3;      // columns of the time axis per point
  constexpr std::size_t LONGEST = 14;  // maximum number of letters in a name
  std::size_t longest = 4;
  for (std::size_t i = 0; i < shown; ++i)
    longest = std::max(longest, std::min(LONGEST, length_of(trace.processors[i])));
  size.scale = style.font_pt / 12;
  size.arrows = to_hundredths(size.arrows * size.scale);
  size.left = to_hundredths(LETTER * style.font_pt * static_cast<double>(longest) + 8 * size.scale);
  size.right = to_hundredths(70 * size.scale);
  size.width = style.width_pt() - size.left - size.right - size.arrows;
  size.columns = static_cast<std::size_t>(std::max(1.0, PER_POINT * size.width));
  return size;
}

class Chart {
 public:
  Chart(const Trace& trace, const base::FigureStyle& style)
      : trace_(trace),
        style_(style),
        shown_(std::min(trace.processors.size(), MOST_PROCESSORS)),
        size_(choose_size(trace, shown_, style)),
        heights_(choose_heights(shown_)),
        timeline_(make_timeline(trace, shown_, size_.columns)),
        links_(shown_) {
    for (auto* height : {&heights_.cpu, &heights_.link, &heights_.gap}) *height = scale(*height);
    for (std::uint32_t i = 0; i < trace.links.size(); ++i)
      if (!timeline_.links[i].columns.empty()) links_[trace.links[i].from].push_back(i);
    top_ = draw_legend();
    bottom_ = top_;
    for (const auto& links : links_)
      bottom_ += heights_.cpu + static_cast<double>(links.size()) * heights_.link + heights_.gap;
  }

  std::string draw() {
    const auto lines =
        trace_.fault.empty() ? 0 : 2 + std::min(trace_.waiting.size(), MOST_TOLD + 1);
    const double height = std::ceil(bottom_ + scale(34 + LINE * static_cast<double>(lines)));
    const auto legend = std::move(text_);
    text_.clear();
    print(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}{2}\" viewBox=\"0 0 "
        "{3} "
        "{1}\" font-family=\"{4}\" font-size=\"{5}\" fill=\"#222\" class=\"drawing\">\n"
        "<title>{6}</title>\n",
        style_.is_figure() ? fmt::format("{:.6g}mm", style_.width_mm)
                           : fmt::format("{}", size_.sum()),
        height, style_.is_figure() ? "pt" : "", to_hundredths(size_.sum()),
        base::escape_xml(style_.font), scale(12), base::escape_xml(trace_.title));
    if (!style_.is_figure())
      print("{}\n<rect class=\"paper\" width=\"{}\" height=\"{}\" fill=\"white\"/>\n",
            base::DARK_MODE, size_.sum(), height);
    text_ += legend;
    draw_axis();
    double y = top_;
    std::vector<double> middles;  // y coordinates of the middles of the CPUs' rows
    for (std::size_t i = 0; i < shown_; ++i) {
      draw_cpu(i, y);
      middles.push_back(y + heights_.cpu / 2);
      y += heights_.cpu;
      for (const auto link : links_[i]) {
        draw_link(link, y);
        y += heights_.link;
      }
      y += heights_.gap;
    }
    if (!trace_.fault.empty()) draw_fault(middles);
    return text_ + "</svg>\n";
  }

 private:
  template <class... Args>
  void print(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }

  // A length that is proportional to the font.
  double scale(double pixels) const { return to_hundredths(pixels * size_.scale); }

  double length_s() const { return trace_.end_s - trace_.begin_s; }

  // Draws the title, except in a figure, and the meaning of colours, in as many lines as needed.
  // Returns the upper edge of the rows.
  double draw_legend() {
    double x = size_.left, y = style_.is_figure() ? scale(14) : 52;
    if (!style_.is_figure())
      print("<text x=\"{}\" y=\"28\" font-size=\"18\">{}</text>\n", size_.left,
            base::escape_xml(shorten(trace_.title, 140)));
    const auto reserve = [&](double width) {
      if (x + width > size_.sum() && x > size_.left) {
        x = size_.left;
        y = to_hundredths(y + scale(18));
      }
    };
    const auto sample = [&](const char* colour, std::string_view name) {
      const double width = scale(40 + 7 * static_cast<double>(name.size()));
      reserve(width - scale(18));
      print(
          "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"#999\" "
          "stroke-width=\"{}\"/>",
          x, to_hundredths(y - scale(10)), scale(16), scale(12), colour, scale(1));
      print("<text x=\"{}\" y=\"{}\">{}</text>\n", to_hundredths(x + scale(22)), y, name);
      x = to_hundredths(x + width);
    };
    sample(LOW, "low priority");
    sample(HIGH, "high priority");
    sample(SWITCHING, "switching");
    sample("white", "idle");
    sample(MESSAGE, "message on a link");
    const auto count =
        shown_ < trace_.processors.size()
            ? fmt::format("the first {} of {} processors", shown_, trace_.processors.size())
            : "";
    auto note = style_.is_figure() ? count : "height: the share of a pixel's time";
    if (!style_.is_figure() && !count.empty()) note += "; " + count;
    reserve(scale(7 * static_cast<double>(note.size())));
    if (!note.empty()) print("<text x=\"{}\" y=\"{}\" fill=\"#666\">{}</text>\n", x, y, note);
    const double top = to_hundredths(y + scale(32));
    print("<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"#666\">busy</text>\n", find_end(),
          to_hundredths(top - scale(8)));
    return top;
  }

  // The x coordinate of the right end of the percentages.
  double find_end() const { return to_hundredths(size_.sum() - size_.arrows - scale(8)); }

  void draw_axis() {
    constexpr double ROOM = 95;  // width in pixels of the label of a tick mark
    const double most = style_.is_figure() ? std::max(2.0, size_.width / scale(ROOM / 2)) : 14;
    const auto [step, unit, name] = choose_ticks(length_s(), most);
    const auto begin = to_nanoseconds(trace_.begin_s), end = to_nanoseconds(trace_.end_s);
    std::string grid;
    for (auto tick = (begin + step - 1) / step * step; tick <= end && begin < end; tick += step) {
      const double x = size_.left + size_.width * static_cast<double>(tick - begin) /
                                        static_cast<double>(end - begin);
      grid += fmt::format("M{:.1f} {}V{}", x, top_ - scale(4), to_hundredths(bottom_ + scale(2)));
      for (const double y : {top_ - scale(8), bottom_ + scale(16)})
        print("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", x, to_hundredths(y),
              tick / unit);
    }
    if (grid.empty()) return;
    print("\n<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n",
          to_hundredths(size_.left - scale(style_.is_figure() ? 8 : 24)),
          to_hundredths(bottom_ + scale(16)), name);
    print("<path d=\"{}\" stroke=\"#ddd\" stroke-width=\"{}\"/>\n", grid, scale(1));
  }

  // Draws a row's name, its percentage of busy time and its base line.
  void draw_frame(double y, double height, const std::string& name, double busy_s, bool is_small) {
    const double size = std::min(scale(is_small ? 9 : 12), height + scale(1));
    if (size >= scale(9)) {
      const auto attributes =
          fmt::format("y=\"{}\" text-anchor=\"end\" font-size=\"{}\" fill=\"{}\"",
                      to_hundredths(y + height / 2 + size / 3), size, is_small ? "#666" : "#222");
      // Number of letters that fit beside the row.
      const auto most = static_cast<std::size_t>((size_.left - scale(8)) / (0.58 * size));
      print("<text x=\"{}\" {}>{}</text>", to_hundredths(size_.left - scale(8)), attributes,
            base::escape_xml(shorten(name, most)));
      print("<text x=\"{}\" {}>{:.1f} %</text>\n", find_end(), attributes,
            length_s() > 0 ? 100 * busy_s / length_s() : 0.0);
    }
    print("<path d=\"M{} {}h{}\" stroke=\"#ccc\" stroke-width=\"{}\"/>\n", size_.left,
          to_hundredths(y + height), to_hundredths(size_.width), scale(0.5));
  }

  // Draws an area whose height in each column is the sum of the column's fractions in `doing`.
  // Callers draw areas on top of each other, the largest first. In a column between an empty and a
  // full one, the area has full height instead, and fills the fraction of the column's width.
  void draw_area(const TimelineRow& row, double height, std::initializer_list<std::size_t> doing,
                 const char* name, const char* colour) {
    // Full height, in halves of unit().
    const int full = static_cast<int>(std::lround(2 * height / unit()));
    std::vector<double> shares;
    std::vector<int> levels;
    for (const auto& column : row.columns) {
      double share = 0;
      for (const auto kind : doing) share += column[kind];
      shares.push_back(share);
      const int least = share > 1e-6 ? 2 : 0;
      levels.push_back(std::max(least, static_cast<int>(std::lround(full * share))));
    }
    std::string path;
    int level = 0;
    const auto draw_step = [&](double x, int to) {
      if (to != level) path += fmt::format("H{}V{}", std::round(10 * x) / 10, 0 - 0.5 * to);
      level = to;
    };
    for (std::size_t x = 0; x < levels.size(); ++x) {
      const int before = x == 0 ? 0 : levels[x - 1],
                after = x + 1 < levels.size() ? levels[x + 1] : 0;
      const auto left = static_cast<double>(x);
      if (before == 0 && after == full)
        draw_step(left + 1 - shares[x], full);
      else if (before == full && after == 0)
        draw_step(left + shares[x], 0);
      else
        draw_step(left, levels[x]);
    }
    if (path.empty()) return;
    print("<path class=\"{}\" fill=\"{}\" {}d=\"M0 0{}H{}V0Z\"/>\n", name, colour,
          style_.is_figure() ? fmt::format("transform=\"scale({:.4f})\" ", unit()) : "", path,
          levels.size());
  }

  // The width of a column. Areas are drawn in this unit.
  double unit() const { return size_.width / static_cast<double>(size_.columns); }

  void draw_cpu(std::size_t i, double y) {
    const double height = heights_.cpu;
    draw_frame(y, height, trace_.processors[i], timeline_.cpus[i].busy_s, false);
    print("<g transform=\"translate({},{})\">\n", size_.left, to_hundredths(y + height));
    constexpr auto high = static_cast<std::size_t>(Trace::Doing::high);
    constexpr auto low = static_cast<std::size_t>(Trace::Doing::low);
    constexpr auto switching = static_cast<std::size_t>(Trace::Doing::switching);
    draw_area(timeline_.cpus[i], height, {low, high, switching}, "switching", SWITCHING);
    draw_area(timeline_.cpus[i], height, {low, high}, "high", HIGH);
    draw_area(timeline_.cpus[i], height, {low}, "low", LOW);
    draw_stretches(timeline_.stretches[i], height);
    print("</g>\n");
  }

  // Draws a thin line at the start of each stretch, and the name of its process if there is room.
  void draw_stretches(const std::vector<TimelineStretch>& stretches, double height) {
    std::string begins;
    for (const auto& stretch : stretches) {
      const double from = unit() * stretch.from, to = unit() * stretch.to;
      begins += fmt::format("M{:.1f} 0v{}", from, -height);
      const auto& name = trace_.processes[stretch.process].name;
      if (height < scale(20) || to - from < scale(6.0 * static_cast<double>(length_of(name)) + 8))
        continue;
      print("<text x=\"{:.1f}\" y=\"{}\" font-size=\"{}\">{}</text>\n", from + scale(4), -scale(6),
            scale(11), base::escape_xml(name));
    }
    if (!begins.empty())
      print("<path d=\"{}\" stroke=\"white\" stroke-width=\"{}\"/>\n", begins, scale(0.7));
  }

  void draw_link(std::uint32_t i, double y) {
    const auto& row = timeline_.links[i];
    draw_frame(y, heights_.link, "to " + trace_.processors[trace_.links[i].to], row.busy_s, true);
    print("<g transform=\"translate({},{})\">\n", size_.left, to_hundredths(y + heights_.link));
    draw_area(row, heights_.link - scale(1), {0}, "message", MESSAGE);
    print("</g>\n");
  }

  // Marks the end of the run, and the cycle of waits by arrows between the rows of its processors.
  // Lists below the chart what each process waits for.
  void draw_fault(const std::vector<double>& middles) {
    print("<path d=\"M{} {}V{}\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
          to_hundredths(size_.left + size_.width), to_hundredths(top_ - scale(4)),
          to_hundredths(bottom_ + scale(2)), FAULT, scale(2));
    for (std::size_t i = 0; i < trace_.cycle; ++i)
      draw_wait(middles, trace_.waiting[i].processor,
                trace_.waiting[(i + 1) % trace_.cycle].processor);
    double y = bottom_ + scale(34 + LINE);
    // Number of letters that fit below the chart.
    const auto most = static_cast<std::size_t>((size_.sum() - size_.left) / (0.58 * scale(12)));
    const auto say = [&](const std::string& text, const char* colour) {
      print("<text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>\n", size_.left, to_hundredths(y), colour,
            base::escape_xml(shorten(text, most)));
      y += scale(LINE);
    };
    say(trace_.fault, FAULT);
    for (std::size_t i = 0; i < std::min(trace_.waiting.size(), MOST_TOLD); ++i) {
      const auto& [process, what, processor] = trace_.waiting[i];
      say(fmt::format("{} on {} waits for {}", process, trace_.processors[processor], what),
          i < trace_.cycle ? FAULT : "#222");
    }
    if (trace_.waiting.size() > MOST_TOLD)
      say(fmt::format("and {} more", trace_.waiting.size() - MOST_TOLD), "#666");
  }

  // Draws an arrow in the right margin, from the row of the waiting processor to the row of the
  // processor for which it waits.
  void draw_wait(const std::vector<double>& middles, std::size_t from, std::size_t to) {
    if (from == to || std::max(from, to) >= middles.size()) return;
    // Arrows leave a row in its upper half and arrive in the lower half of another.
    const double x = to_hundredths(size_.sum() - size_.arrows);
    const double a = to_hundredths(middles[from] - scale(4)),
                 b = to_hundredths(middles[to] + scale(4));
    const double bend = std::min(scale(ARROWS - 10), scale(20) + std::abs(b - a) / 4);
    print(
        "<path class=\"wait\" d=\"M{0} {1}C{2} {1} {2} {3} {4} {3}\" fill=\"none\" stroke=\"{5}\" "
        "stroke-width=\"{6}\"/><path d=\"M{0} {3}L{4} {7}L{4} {8}Z\" fill=\"{5}\"/>\n",
        x, a, to_hundredths(x + bend), b, to_hundredths(x + scale(8)), FAULT, scale(1.6),
        to_hundredths(b - scale(4)), to_hundredths(b + scale(4)));
  }

  const Trace& trace_;
  const base::FigureStyle& style_;
  std::size_t shown_;  // number of processors in the chart
  ChartSize size_;
  Heights heights_;
  Timeline timeline_;
  std::vector<std::vector<std::uint32_t>> links_;  // links drawn, by processor
  double top_ = 0, bottom_ = 0;                    // upper and lower edge of all rows
  std::string text_;
};

}  // namespace

void save_timeline(const Trace& trace, std::ostream& out) { out << draw_timeline(trace, {}); }

std::string draw_timeline(const Trace& trace, const base::FigureStyle& style) {
  check(trace);
  return Chart(trace, style).draw();
}

}  // namespace observe
