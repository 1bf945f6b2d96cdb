#include "experiments/laboratory/film/fault_drawings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/figure/pdf.hpp"
#include "experiments/laboratory/host/results_folder.hpp"
#include "experiments/laboratory/host/temporary_folder.hpp"
#include "experiments/laboratory/places/places.hpp"
#include "experiments/laboratory/points/run_point.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "simulator/observe/timeline.hpp"
#include "topologies/draw/sheet.hpp"
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

constexpr auto RED = "#b40000";

// Breaks a text into lines of at most so many letters, at blanks if possible.
std::vector<std::string> wrap(const std::string& text, std::size_t most) {
  std::vector<std::string> lines;
  std::string line;
  for (const auto& word : base::split(text, ' ')) {
    if (!line.empty() && line.size() + 1 + word.size() > most)
      lines.push_back(std::exchange(line, ""));
    if (!line.empty()) line += " ";
    line += word;
  }
  lines.push_back(line);
  return lines;
}

void draw_links(topologies::Sheet& sheet, const observe::Trace& trace,
                const topologies::Places& places, const topologies::Measures& m) {
  for (const auto& [from, to] : trace.links)
    if (from < to)
      sheet.curve(topologies::make_curve(places[from], places[to], {}), "#bbbbbb",
                  0.055 * m.processor);
}

// The curve of an arrow between two circles. It leaves and arrives aside of the straight line, so
// that opposite arrows are apart, and long arrows go around the circles between their ends.
std::array<topologies::Place, 4> make_arrow(const topologies::Place& from,
                                            const topologies::Place& to, double radius) {
  constexpr double ANGLE = 0.7;
  const double x = to.x - from.x, y = to.y - from.y, length = std::hypot(x, y);
  const double cosine = std::cos(ANGLE) / length, sine = std::sin(ANGLE) / length;
  const topologies::Place out{cosine * x + sine * y, cosine * y - sine * x};
  const topologies::Place in{-cosine * x + sine * y, -cosine * y - sine * x};
  const auto at = [](const topologies::Place& origin, const topologies::Place& way, double far) {
    return topologies::Place{origin.x + far * way.x, origin.y + far * way.y};
  };
  const double bend = radius + 0.3 * (length - radius);
  return {at(from, out, radius), at(from, out, bend), at(to, in, bend), at(to, in, radius)};
}

// Describes a wait: "p0.station on p0 waits for out on p1.in".
std::string describe_wait(const observe::Trace& trace, std::size_t i) {
  const auto& [process, what, processor] = trace.waiting[i];
  return fmt::format("{} on {} waits for {}", process, trace.processors[processor], what);
}

void draw_cycle(topologies::Sheet& sheet, const observe::Trace& trace,
                const topologies::Places& places, const topologies::Measures& m) {
  for (std::size_t i = 0; i < trace.cycle; ++i) {
    const auto from = trace.waiting[i].processor;
    const auto to = trace.waiting[(i + 1) % trace.cycle].processor;
    if (from == to) continue;
    sheet.open("wait", describe_wait(trace, i));
    sheet.arrow(make_arrow(places[from], places[to], 0.5 * m.processor / m.unit), RED,
                0.06 * m.processor);
    sheet.close();
  }
}

void draw_processors(topologies::Sheet& sheet, const observe::Trace& trace,
                     const topologies::Places& places, const topologies::Measures& m) {
  std::vector<bool> waits(places.size()), is_in_cycle(places.size());
  for (std::size_t i = 0; i < trace.waiting.size(); ++i)
    (i < trace.cycle ? is_in_cycle : waits)[trace.waiting[i].processor] = true;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto at = sheet.to_points(places[i]);
    sheet.open("processor", trace.processors[i]);
    sheet.circle(at, m.processor, is_in_cycle[i] ? "#fbe3e0" : "#f4f4f2",
                 (is_in_cycle[i] ? 0.06 : 0.03) * m.processor,
                 is_in_cycle[i] ? RED
                 : waits[i]     ? "#777777"
                                : "#bbbbbb");
    const auto [shown, size] = topologies::fit_name(m, trace.processors[i]);
    if (!shown.empty()) sheet.text(at, shown, {size});
    sheet.close();
  }
}

// Writes the fault and the waits of its cycle below the machine, whose middle is at x = `middle`.
void write_waits(topologies::Sheet& sheet, const observe::Trace& trace, double middle,
                 double font) {
  constexpr double NARROWEST = 460, MARGIN = 8;
  const auto& style = sheet.style();
  const double used = sheet.high().x - sheet.low().x;
  const double width = style.is_figure() ? style.width_pt() - MARGIN : std::max(NARROWEST, used);
  const double left = middle - width / 2;
  const auto most = static_cast<std::size_t>(width / topologies::Sheet::width_of("x", font));
  double y = sheet.high().y + 2 * font;
  sheet.include({middle, y}, width, font);
  const auto say = [&](const std::string& text, const char* colour) {
    for (const auto& line : wrap(text, most)) {
      sheet.text({left, y}, line, {font, colour, false, true});
      y += 1.4 * font;
    }
  };
  say(trace.fault, "#000000");
  for (std::size_t i = 0; i < trace.cycle; ++i) say(describe_wait(trace, i), RED);
}

}  // namespace

std::string draw_waits(const observe::Trace& trace, const topologies::Places& places,
                       const base::FigureStyle& style) {
  constexpr double TITLE = 14;      // font size in points
  constexpr double DISTANCE = 1.8;  // of two processors on the screen, in diameters
  std::size_t longest = 0;
  for (const auto& name : trace.processors) longest = std::max(longest, name.size());
  auto m = topologies::choose_measures(places, longest, 0, style);
  if (!style.is_figure()) m.unit = DISTANCE * m.processor;
  topologies::Sheet sheet(style, m.unit);
  draw_links(sheet, trace, places, m);
  draw_cycle(sheet, trace, places, m);
  draw_processors(sheet, trace, places, m);
  const double middle = (sheet.low().x + sheet.high().x) / 2;
  if (!style.is_figure()) sheet.text({middle, sheet.low().y - TITLE}, trace.title, {TITLE});
  write_waits(sheet, trace, middle, m.font);
  return sheet.finish(trace.title);
}

std::string draw_fault(const Point& point, const RunOptions& options, const PointResult& failure,
                       const base::FigureStyle& style) {
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
  const auto save = [&](const std::string& what, const std::string& name, const auto& draw) {
    base::save_whole(name + ".svg", draw(base::FigureStyle{}));
    files += fmt::format("\n  {} {}.svg", what, name);
    if (!style.is_figure()) return;
    base::save_whole(name + ".pdf", svg_to_pdf(draw(style), name));
    files += fmt::format(", {}.pdf", name);
  };
  if (const auto parent = fs::path(stem).parent_path(); !parent.empty())
    fs::create_directories(parent);
  if (!observer.places().empty())
    save("who waits for whom:", stem,
         [&](const base::FigureStyle& of) { return draw_waits(trace, observer.places(), of); });
  save("the time line:     ", stem + "-timeline",
       [&](const base::FigureStyle& of) { return observe::draw_timeline(trace, of); });
  return files;
}

Explain draw_faults(const base::FigureStyle& style) {
  return [style](const Point& point, const RunOptions& options, const PointResult& failure) {
    return draw_fault(point, options, failure, style);
  };
}

}  // namespace laboratory
