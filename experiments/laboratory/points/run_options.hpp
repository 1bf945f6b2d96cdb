#pragma once
// Options of tlab run.
#include <limits>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// Options of --animate.
struct FilmOptions {
  /// film files (.webp), or .png for frames NAME-0001.png ...; "": no film
  std::string picture, network;
  int frames = 100;
  bool is_confirmed = false;  ///< --yes: draw the films even if that takes long

  bool is_asked() const { return !picture.empty() || !network.empty(); }
};

inline constexpr int MIN_FRAMES = 2, MAX_FRAMES = 1000;

/// The options of tlab run.
struct RunOptions {
  std::string file;         ///< experiment file
  std::string output;       ///< results folder; "": results/NAME
  Overrides overrides;      ///< values of --set
  bool is_reduced = false;  ///< use the values of [reduced]
  unsigned jobs = 1;        ///< number of parallel jobs: points to run, and networks to draw
  unsigned threads = 1;     ///< threads for each point; results do not depend on their number
  bool profile = false;
  double until_s = std::numeric_limits<double>::infinity();  ///< end of simulated time
  double from_s = 0;     ///< simulated time at which trace, timeline and films start
  std::string trace;     ///< trace file of the only point: .json (Perfetto) or .paje; "": none
  std::string timeline;  ///< Gantt chart of the only point: .svg file; "": none
  FilmOptions films;     ///< films of the only point
  bool list = false;
  std::vector<std::string> points;  ///< values of --point: "3" or "3-5", numbered from 0

  bool wants_trace() const { return !trace.empty() || !timeline.empty() || !films.network.empty(); }
  /// True if points are simulated even if they have results.
  bool runs_anew() const { return profile || wants_trace() || films.is_asked(); }
};

}  // namespace laboratory
