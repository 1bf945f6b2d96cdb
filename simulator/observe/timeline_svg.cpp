// Draws a timeline as an SVG, 1600 pixels wide. Names are on the left, percentages of busy time on
// the right, and each pixel column between them shows a part of the time.

#include <algorithm>
#include <iterator>

#include "base/text.hpp"
#include "simulator/observe/ticks.hpp"
#include "simulator/observe/timeline.hpp"
#include "simulator/observe/trace_output.hpp"

namespace observe {

namespace {

constexpr int LEFT = 150, WIDTH = 1380, RIGHT = 70, TOP = 84, BOTTOM = 34;  // in pixels
constexpr std::size_t MOST_PROCESSORS = 64;
constexpr int LINE = 16;               // height of a line of text, in pixels
constexpr int ARROWS = 90;             // width of the margin with the arrows of a cycle of waits
constexpr std::size_t MOST_TOLD = 24;  // waiting processes listed below the chart
constexpr auto FAULT = "#b40000";
constexpr auto LOW = "#9ecae1", HIGH = "#e6550d", SWITCHING = "#3b3b3b", MESSAGE = "#41ab5d";

// Heights of rows in pixels.
struct Heights {
  int cpu, link, gap;
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

class Chart {
 public:
  explicit Chart(const Trace& trace)
      : trace_(trace),
        shown_(std::min(trace.processors.size(), MOST_PROCESSORS)),
        heights_(choose_heights(shown_)),
        timeline_(make_timeline(trace, shown_, WIDTH)),
        links_(shown_) {
    for (std::uint32_t i = 0; i < trace.links.size(); ++i)
      if (!timeline_.links[i].columns.empty()) links_[trace.links[i].from].push_back(i);
    bottom_ = TOP;
    for (const auto& links : links_)
      bottom_ += heights_.cpu + static_cast<int>(links.size()) * heights_.link + heights_.gap;
    if (trace.cycle > 0) right_ += ARROWS;
    if (!trace.fault.empty())
      told_ = LINE * (2 + static_cast<int>(std::min(trace.waiting.size(), MOST_TOLD + 1)));
  }

  std::string draw() {
    print(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
        "{1}\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#222\">\n"
        "<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
        LEFT + WIDTH + right_, bottom_ + BOTTOM + told_, base::escape_xml(trace_.title));
    draw_head();
    draw_axis();
    int y = TOP;
    std::vector<int> middles;  // y of the CPUs' rows
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

  double length_s() const { return trace_.end_s - trace_.begin_s; }

  void draw_head() {
    print("<text x=\"{}\" y=\"28\" font-size=\"18\">{}</text>\n", LEFT,
          base::escape_xml(shorten(trace_.title, 140)));
    int x = LEFT;
    const auto sample = [&](const char* colour, std::string_view name) {
      print("<rect x=\"{}\" y=\"42\" width=\"16\" height=\"12\" fill=\"{}\" stroke=\"#999\"/>", x,
            colour);
      print("<text x=\"{}\" y=\"52\">{}</text>\n", x + 22, name);
      x += 40 + static_cast<int>(7 * name.size());
    };
    sample(LOW, "low priority");
    sample(HIGH, "high priority");
    sample(SWITCHING, "switching");
    sample("white", "idle");
    sample(MESSAGE, "message on a link");
    print("<text x=\"{}\" y=\"52\" fill=\"#666\">height: the share of a pixel's time{}</text>\n", x,
          shown_ < trace_.processors.size()
              ? fmt::format("; the first {} of {} processors", shown_, trace_.processors.size())
              : "");
    print("<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"#666\">busy</text>\n",
          LEFT + WIDTH + RIGHT - 8, TOP - 8);
  }

  void draw_axis() {
    const auto [step, unit, name] = choose_ticks(length_s());
    const auto begin = to_nanoseconds(trace_.begin_s), end = to_nanoseconds(trace_.end_s);
    std::string grid;
    for (auto tick = (begin + step - 1) / step * step; tick <= end && begin < end; tick += step) {
      const double x =
          LEFT + WIDTH * static_cast<double>(tick - begin) / static_cast<double>(end - begin);
      grid += fmt::format("M{:.1f} {}V{}", x, TOP - 4, bottom_ + 2);
      for (const int y : {TOP - 8, bottom_ + 16})
        print("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", x, y, tick / unit);
    }
    if (grid.empty()) return;
    print("\n<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n", LEFT - 24, bottom_ + 16,
          name);
    print("<path d=\"{}\" stroke=\"#ddd\"/>\n", grid);
  }

  // Draws a row's name, its percentage of busy time and the line at its bottom.
  void draw_frame(int y, int height, const std::string& name, double busy_s, bool is_small) {
    const int size = std::min(is_small ? 9 : 12, height + 1);
    if (size >= 9) {
      const auto attributes =
          fmt::format("y=\"{}\" text-anchor=\"end\" font-size=\"{}\" fill=\"{}\"",
                      y + height / 2 + size / 3, size, is_small ? "#666" : "#222");
      print("<text x=\"{}\" {}>{}</text>", LEFT - 8, attributes,
            base::escape_xml(shorten(name, is_small ? 26 : 20)));
      print("<text x=\"{}\" {}>{:.1f} %</text>\n", LEFT + WIDTH + RIGHT - 8, attributes,
            length_s() > 0 ? 100 * busy_s / length_s() : 0.0);
    }
    print("<path d=\"M{} {}h{}\" stroke=\"#ccc\" stroke-width=\"0.5\"/>\n", LEFT, y + height,
          WIDTH);
  }

  // Draws an area. Its height in each column is the sum of the column's fractions of the activities
  // in `doing`. Callers draw areas on top of each other, the largest first. If a column lies
  // between an empty and a full one, draws a vertical edge within the column instead, at a position
  // that shows the fraction.
  void draw_area(const TimelineRow& row, int height, std::initializer_list<std::size_t> doing,
                 const char* name, const char* colour) {
    const int full = 2 * height;  // in half pixels
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
    print("<path class=\"{}\" fill=\"{}\" d=\"M0 0{}H{}V0Z\"/>\n", name, colour, path,
          levels.size());
  }

  void draw_cpu(std::size_t i, int y) {
    const int height = heights_.cpu;
    draw_frame(y, height, trace_.processors[i], timeline_.cpus[i].busy_s, false);
    print("<g transform=\"translate({},{})\">\n", LEFT, y + height);
    constexpr auto high = static_cast<std::size_t>(Trace::Doing::high);
    constexpr auto low = static_cast<std::size_t>(Trace::Doing::low);
    constexpr auto switching = static_cast<std::size_t>(Trace::Doing::switching);
    draw_area(timeline_.cpus[i], height, {low, high, switching}, "switching", SWITCHING);
    draw_area(timeline_.cpus[i], height, {low, high}, "high", HIGH);
    draw_area(timeline_.cpus[i], height, {low}, "low", LOW);
    draw_stretches(timeline_.stretches[i], height);
    print("</g>\n");
  }

  // Draws a thin line at the start of each period of a process, and the process's name if there is
  // room.
  void draw_stretches(const std::vector<TimelineStretch>& stretches, int height) {
    std::string begins;
    for (const auto& stretch : stretches) {
      begins += fmt::format("M{:.1f} 0v{}", stretch.from, -height);
      const auto& name = trace_.processes[stretch.process].name;
      if (height < 20 || stretch.to - stretch.from < 6.0 * static_cast<double>(length_of(name)) + 8)
        continue;
      print("<text x=\"{:.1f}\" y=\"-6\" font-size=\"11\">{}</text>\n", stretch.from + 4,
            base::escape_xml(name));
    }
    if (!begins.empty()) print("<path d=\"{}\" stroke=\"white\" stroke-width=\"0.7\"/>\n", begins);
  }

  void draw_link(std::uint32_t i, int y) {
    const auto& row = timeline_.links[i];
    draw_frame(y, heights_.link, "to " + trace_.processors[trace_.links[i].to], row.busy_s, true);
    print("<g transform=\"translate({},{})\">\n", LEFT, y + heights_.link);
    draw_area(row, heights_.link - 1, {0}, "message", MESSAGE);
    print("</g>\n");
  }

  // Marks the end of the run, and the cycle of waits by arrows between the rows of its processors.
  // Lists below the chart what each process waits for.
  void draw_fault(const std::vector<int>& middles) {
    print("<path d=\"M{} {}V{}\" stroke=\"{}\" stroke-width=\"2\"/>\n", LEFT + WIDTH, TOP - 4,
          bottom_ + 2, FAULT);
    print(
        "<defs><marker id=\"tip\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"7\" "
        "markerHeight=\"7\" orient=\"auto\"><path d=\"M0 0L8 4L0 8z\" "
        "fill=\"{}\"/></marker></defs>\n",
        FAULT);
    for (std::size_t i = 0; i < trace_.cycle; ++i)
      draw_wait(middles, trace_.waiting[i].processor,
                trace_.waiting[(i + 1) % trace_.cycle].processor);
    int y = bottom_ + BOTTOM + LINE;
    const auto say = [&](const std::string& text, const char* colour) {
      print("<text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>\n", LEFT, y, colour,
            base::escape_xml(shorten(text, 220)));
      y += LINE;
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

  // Draws an arrow in the right margin, from the row of the waiting processor to that of the other.
  void draw_wait(const std::vector<int>& middles, std::size_t from, std::size_t to) {
    if (from == to || std::max(from, to) >= middles.size()) return;
    // arrows leave a row in its upper half and arrive in the lower
    const int x = LEFT + WIDTH + RIGHT, a = middles[from] - 4, b = middles[to] + 4;
    const int bend = std::min(ARROWS - 10, 20 + std::abs(b - a) / 4);
    print(
        "<path class=\"wait\" d=\"M{0} {1}C{2} {1} {2} {3} {0} {3}\" fill=\"none\" stroke=\"{4}\" "
        "stroke-width=\"1.6\" marker-end=\"url(#tip)\"/>\n",
        x, a, x + bend, b, FAULT);
  }

  const Trace& trace_;
  std::size_t shown_;  // number of processors that are drawn
  Heights heights_;
  Timeline timeline_;
  std::vector<std::vector<std::uint32_t>> links_;  // links drawn, by processor
  int bottom_ = 0;                                 // lower edge of all rows, in pixels
  int right_ = RIGHT;                              // width of the right margin, in pixels
  int told_ = 0;                                   // height of the text on a fault, in pixels
  std::string text_;
};

}  // namespace

void save_timeline(const Trace& trace, std::ostream& out) {
  check(trace);
  out << Chart(trace).draw();
}

}  // namespace observe
