#include "experiments/laboratory/film/recorded_point.hpp"

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/figure/pdf.hpp"
#include "experiments/laboratory/film/film.hpp"
#include "experiments/laboratory/host/error_text.hpp"
#include "experiments/laboratory/host/link_files.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/points/run_point.hpp"
#include "experiments/laboratory/setup/setup.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;
using base::require;

// Writes a trace. Only a timeline has a style.
using Save = void (*)(const observe::Trace&, std::ostream&, const base::FigureStyle&);

// Finds the function that writes a trace, by the file's extension; null if the extension is
// unknown.
Save find_format(const std::string& file) {
  const auto ending = fs::path(file).extension();
  if (ending == ".json") return [](auto& trace, auto& out, auto&) { save_chrome(trace, out); };
  if (ending == ".paje" || ending == ".trace")
    return [](auto& trace, auto& out, auto&) { save_paje(trace, out); };
  if (ending == ".svg")
    return [](auto& trace, auto& out, auto& style) { out << draw_timeline(trace, style); };
  if (ending == ".pdf")
    return [](auto& trace, auto& out, auto& style) {
      out << svg_to_pdf(draw_timeline(trace, style), "timeline");
    };
  return nullptr;
}

// Throws if an output file lies inside the results folder or cannot be written, so that the user
// learns of it before the simulation.
void check_place(const char* option, const std::string& file, const fs::path& results) {
  const auto inside = fs::weakly_canonical(fs::absolute(file))
                          .lexically_relative(fs::weakly_canonical(fs::absolute(results)));
  require(inside.empty() || *inside.begin() == "..", option,
          "found {}, expected a file outside the results folder {}, which is replaced as a whole",
          file, results.string());
  base::check_can_save(file);
}

void check_single(const char* option, std::size_t points) {
  require(points == 1, option,
          "the experiment has {} points, expected one; choose it with --set, for example "
          "--set 'sweep.workers=[4]'",
          points);
}

void save_recordings(const Point& point, const RunOptions& options, observe::Trace& trace,
                     const Film& film, const base::FigureStyle& style, bool is_interrupted) {
  const auto& said = point.experiment.title;
  const auto title = said.empty() ? fs::path(options.file).stem().string() : said;
  trace.title = point.at.empty() ? title : fmt::format("{}: {}", title, name_of(point));
  for (const auto& file : {options.trace, options.timeline})
    if (!file.empty())
      base::save_whole(file, [&](std::ostream& out) { find_format(file)(trace, out, style); });
  if (film.has_begun() || !is_interrupted) film.save(trace.title, trace);
}

// Runs a point as run_point() does, and writes the requested recordings, even if a fault ends the
// simulation.
PointResult run_recorded_point(const Point& point, const RunOptions& options,
                               const fs::path& images, const base::FigureStyle& style) {
  if (!options.wants_trace() && !options.films.is_asked()) return run_point(point, options, images);
  check_films(options.films, point.experiment);
  const bool draws = !options.films.network.empty();
  Film film(options.films, draws ? make_workers(point.experiment) : topologies::Topology{},
            options.from_s);
  observe::Trace trace;
  observe::RunMonitor monitor;
  if (options.wants_trace()) monitor.trace = &trace;
  if (options.films.is_asked()) monitor.observer = &film;
  try {
    auto result = run_point(point, options, images, monitor);
    save_recordings(point, options, trace, film, style, result.ended == "interrupt");
    return result;
  } catch (const machine::Fault&) {
    try {
      save_recordings(point, options, trace, film, style, false);
    } catch (const std::exception& error) {  // only reports it, to throw the fault instead
      complain(fmt::format("no trace or chart of the run so far: {}", describe_error(error)));
    }
    throw;
  }
}

}  // namespace

void check_recordings(const RunOptions& options, const ExperimentFile& file, std::size_t points) {
  for (const auto& [option, path, endings] :
       {std::tuple("--trace", options.trace, ".json or .paje"),
        std::tuple("--timeline", options.timeline, ".svg or .pdf")}) {
    if (path.empty()) continue;
    const auto ending = fs::path(path).extension();
    const bool is_chart = ending == ".svg" || ending == ".pdf";
    require(find_format(path) && is_chart == (std::string_view(option) == "--timeline"), option,
            "found {}, expected a name that ends in {}", path, endings);
    check_single(option, points);
    check_place(option, path, results_folder(options));
  }
  for (const auto& film : {options.films.picture, options.films.network}) {
    if (film.empty()) continue;
    const auto first = first_file(film);
    // A film without a given name lies beside the results folder, whose parent folder may be
    // missing.
    const auto folder = results_folder(options).parent_path();
    if (!folder.empty() && fs::path(first).parent_path() == folder) make_folders(folder);
    check_single("--animate", points);
    check_place("--animate", first, results_folder(options));
  }
  require(options.from_s == 0 || options.from_s < options.until_s, "--from",
          "found {}, expected a time before --until {}", options.from_s, options.until_s);
  if (points == 1)
    base::at_place(file.path, [&] { check_films(options.films, file.points[0].experiment); });
}

RunPoint record_points(const ExperimentFile& file) {
  return [style = file.report.figure.make_style({})](const Point& point, const RunOptions& options,
                                                     const fs::path& images) {
    return run_recorded_point(point, options, images, style);
  };
}

}  // namespace laboratory
