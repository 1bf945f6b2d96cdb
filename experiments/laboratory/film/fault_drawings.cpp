#include "experiments/laboratory/film/fault_drawings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/figure/figure_style.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/results_folder.hpp"
#include "experiments/laboratory/host/temporary_folder.hpp"
#include "experiments/laboratory/places/places.hpp"
#include "experiments/laboratory/points/run_point.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

constexpr double MOST_REPEATED_S = 60;    // limit on the CPU time of a repetition
constexpr double TRACED_S = 1;            // CPU time of the part of a run that is traced
constexpr std::size_t MOST_DRAWN = 1024;  // limit on processors in the drawing

// Records the waiting processes and the positions of processors at the end of a run.
class WaitObserver : public observe::RunObserver {
 public:
  WaitObserver(const Point& point, observe::Trace& trace) : point_(point), trace_(trace) {}

  void begin(const machine::Machine& machine, const observe::ControlPanel& view) override {
    machine_ = &machine;
    network_ = view.network;
  }
  void before_change(double) override {}
  void end(double) override {
    // after an exception in a process, there are no waits left to record
    if (std::ranges::any_of(machine_->processors(),
                            [](const auto& on) { return on->failure() != nullptr; }))
      return;
    const auto cycle = machine::find_wait_cycle(*machine_);
    // the list of the cycle ends with its first process again
    trace_.cycle = cycle.empty() ? 0 : cycle.size() - 1;
    for (std::size_t i = 0; i < trace_.cycle; ++i) add(*cycle[i]);
    for (const auto& processor : machine_->processors())
      for (const auto& process : processor->processes())
        if (process->state() == machine::Process::State::blocked && process->wait() &&
            std::ranges::find(cycle, process.get()) == cycle.end())
          add(*process);
    place();
  }

  const topologies::Places& places() const { return places_; }

 private:
  void add(const machine::Process& process) {
    trace_.waiting.push_back({process.name(), process.wait()->describe(),
                              static_cast<std::uint32_t>(process.processor().id())});
  }

  void place() {
    if (trace_.cycle == 0 || machine_->processors().size() > MOST_DRAWN) return;
    const auto& e = point_.experiment;
    places_ = place_processors(
        *machine_, e.program->uses.network ? make_workers(e) : topologies::make_line(1), network_);
  }

  const Point& point_;
  observe::Trace& trace_;
  const machine::Machine* machine_ = nullptr;
  std::vector<int> network_;
  topologies::Places places_;
};

// The files' common path: RESULTS-fault, or RESULTS-fault-AXIS-VALUE in a sweep.
std::string choose_stem(const Point& point, const RunOptions& options) {
  auto results = results_folder(options).lexically_normal();
  if (!results.has_filename()) results = results.parent_path();
  auto stem = results.string() + "-fault";
  if (point.at.empty()) return stem;
  std::string name;
  for (const char c : name_of(point))
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.')
      name += c;
    else if (!name.empty() && !name.ends_with('-'))
      name += '-';
  if (name.ends_with('-')) name.pop_back();
  return fmt::format("{}-{}", stem, name);
}

// Runs the point again with a trace of its end, and expects the fault. Uses the engine "direct",
// because a process can run SimGrid only once. Both engines give the same results.
void repeat(const Point& point, const RunOptions& options, const PointResult& failure,
            observe::Trace& trace, WaitObserver& observer) {
  RunOptions again;
  again.file = options.file;
  again.until_s = options.until_s;
  const double run_s = failure.host.total_s;
  again.from_s = run_s > TRACED_S ? *failure.fault_s * (1 - TRACED_S / run_s) : 0;
  Point direct = point;
  direct.experiment.engine.links = machine::Links::direct;
  const TemporaryFolder images;
  try {
    run_point(direct, again, images.path(), {.trace = &trace, .observer = &observer});
  } catch (const machine::Fault&) {
  }
}

// A position in the drawing, in pixels from its upper left corner.
struct Screen {
  double x, y;
};

// Draws the machine: grey links, processors with names, and red arrows for the cycle.
class WaitDrawing {
 public:
  WaitDrawing(const observe::Trace& trace, const topologies::Places& places)
      : trace_(trace), places_(places) {
    for (const auto& place : places) {
      left_ = std::min(left_, place.x);
      top_ = std::max(top_, place.y);
      right_ = std::max(right_, place.x);
      low_ = std::min(low_, place.y);
    }
  }

  std::string draw() {
    const double width = std::max(620., 2 * MARGIN + UNIT * (right_ - left_));
    const double drawn = 2 * MARGIN + UNIT * (top_ - low_) + 24;
    print(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\" "
        "fill=\"#222\" class=\"drawing\">\n<title>{2}</title>\n{4}\n<rect width=\"{0:.0f}\" "
        "height=\"{1:.0f}\" "
        "fill=\"white\"/>\n<defs><marker id=\"tip\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" "
        "markerWidth=\"5\" markerHeight=\"5\" orient=\"auto\"><path d=\"M0 0L8 4L0 8z\" "
        "fill=\"{3}\"/></marker></defs>\n<text x=\"20\" y=\"26\" font-size=\"15\">{2}</text>\n",
        width, drawn + LINE * static_cast<double>(trace_.cycle + 1), base::escape_xml(trace_.title),
        RED, base::DARK_MODE);
    draw_links();
    draw_cycle();
    draw_processors();
    say(drawn, trace_.fault, "#222");
    for (std::size_t i = 0; i < trace_.cycle; ++i) {
      const auto& [process, what, processor] = trace_.waiting[i];
      say(drawn + LINE * static_cast<double>(i + 1),
          fmt::format("{} on {} waits for {}", process, trace_.processors[processor], what), RED);
    }
    return text_ + "</svg>\n";
  }

 private:
  static constexpr double UNIT = 90, MARGIN = 60, RADIUS = 22, LINE = 17;
  static constexpr auto RED = "#b40000";

  template <class... Args>
  void print(fmt::format_string<Args...> format, Args&&... args) {
    text_ += fmt::format(format, std::forward<Args>(args)...);
  }

  void say(double y, const std::string& text, const char* colour) {
    print("<text x=\"20\" y=\"{:.0f}\" fill=\"{}\">{}</text>\n", y, colour, base::escape_xml(text));
  }

  Screen at(std::uint32_t processor) const {
    const auto& place = places_[processor];
    return {MARGIN + UNIT * (place.x - left_), MARGIN + 20 + UNIT * (top_ - place.y)};
  }

  void draw_links() {
    for (const auto& [from, to] : trace_.links) {
      const auto a = at(from), b = at(to);
      if (from < to)
        print("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#bbb\" stroke-width=\"2\"/>\n",
              a.x, a.y, b.x, b.y);
    }
  }

  // Draws an arrow for each wait, bent to its right so that opposite arrows are apart.
  void draw_cycle() {
    for (std::size_t i = 0; i < trace_.cycle; ++i) {
      const auto a = at(trace_.waiting[i].processor);
      const auto b = at(trace_.waiting[(i + 1) % trace_.cycle].processor);
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      if (length == 0) continue;  // both processes run on one processor
      const double ux = (b.x - a.x) / length, uy = (b.y - a.y) / length;
      // long arrows go around the processors between their ends
      const double bend = std::clamp(0.3 * length, 28., 100.);
      const double ex = RADIUS * ux, ey = RADIUS * uy;
      print(
          "<path class=\"wait\" d=\"M{:.1f} {:.1f}Q{:.1f} {:.1f} {:.1f} {:.1f}\" fill=\"none\" "
          "stroke=\"{}\" stroke-width=\"2.4\" marker-end=\"url(#tip)\"/>\n",
          a.x + ex, a.y + ey, (a.x + b.x) / 2 - bend * uy, (a.y + b.y) / 2 + bend * ux, b.x - ex,
          b.y - ey, RED);
    }
  }

  void draw_processors() {
    std::vector<bool> waits(places_.size()), is_in_cycle(places_.size());
    for (std::size_t i = 0; i < trace_.waiting.size(); ++i)
      (i < trace_.cycle ? is_in_cycle : waits)[trace_.waiting[i].processor] = true;
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      const auto [x, y] = at(i);
      print(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" "
          "stroke-width=\"{}\"/><text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" "
          "font-size=\"{:.0f}\">{}</text>\n",
          x, y, RADIUS, is_in_cycle[i] ? "#fbe3e0" : "#f4f4f2",
          is_in_cycle[i] ? RED
          : waits[i]     ? "#777"
                         : "#bbb",
          is_in_cycle[i] ? 2 : 1, x, y + 4,
          std::clamp(3.4 * RADIUS / static_cast<double>(trace_.processors[i].size()), 7., 12.),
          base::escape_xml(trace_.processors[i]));
    }
  }

  const observe::Trace& trace_;
  const topologies::Places& places_;
  double left_ = 1e9, low_ = 1e9, right_ = -1e9, top_ = -1e9;
  std::string text_;
};

}  // namespace

std::string draw_waits(const observe::Trace& trace, const topologies::Places& places) {
  return WaitDrawing(trace, places).draw();
}

std::string draw_fault(const Point& point, const RunOptions& options, const PointResult& failure) {
  if (!failure.fault_s || point.experiment.is_timed || failure.host.total_s > MOST_REPEATED_S)
    return "";
  observe::Trace trace;
  WaitObserver observer(point, trace);
  repeat(point, options, failure, trace, observer);
  if (trace.processors.empty()) return "";  // the fault was before the simulation
  const auto& title = point.experiment.title;
  trace.title = title.empty() ? fs::path(options.file).stem().string() : title;
  if (!point.at.empty()) trace.title += ": " + name_of(point);
  trace.fault = failure.message.substr(0, failure.message.find('\n'));
  if (trace.fault.ends_with(':')) trace.fault.pop_back();
  const auto stem = choose_stem(point, options);
  std::string files;
  const auto save = [&](const std::string& what, const std::string& file, const auto& write) {
    base::save_whole(file, write);
    files += fmt::format("\n  {} {}", what, file);
  };
  if (const auto parent = fs::path(stem).parent_path(); !parent.empty())
    fs::create_directories(parent);
  if (!observer.places().empty())
    save("who waits for whom:", stem + ".svg",
         [&](std::ostream& out) { out << draw_waits(trace, observer.places()); });
  save("the time line:     ", stem + "-timeline.svg",
       [&](std::ostream& out) { observe::save_timeline(trace, out); });
  return files;
}

}  // namespace laboratory
