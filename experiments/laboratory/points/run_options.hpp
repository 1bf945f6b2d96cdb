#pragma once
// Options of tlab run.
#include <limits>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// Options of --animate.
struct FilmOptions {
  /// file of the film (.webp), or NAME.png for the frames NAME-0001.png ...; "": no film
  std::string picture, network;
  int frames = 100;
  /// true: the user gave --yes, to draw the films even if it takes long
  bool is_confirmed = false;

  bool is_asked() const { return !picture.empty() || !network.empty(); }
};

inline constexpr int MIN_FRAMES = 2, MAX_FRAMES = 1000;

/// The options of tlab run. Simulated times are in seconds from the start of the program.
struct RunOptions {
  std::string file;  ///< experiment file
  /// results folder; "": results/NAME, where NAME is that of the experiment file
  std::string output;
  Overrides overrides;      ///< values of --set
  bool is_reduced = false;  ///< true: use the values of [reduced]
  /// number of processes that simulate points or draw networks at the same time
  unsigned jobs = 1;
  /// threads that simulate each point; results do not depend on their number
  unsigned threads = 1;
  bool profile = false;
  /// simulated time at which a simulation ends at the latest
  double until_s = std::numeric_limits<double>::infinity();
  double from_s = 0;     ///< simulated time at which trace, timeline and films start
  std::string trace;     ///< trace file of the only point: .json (Perfetto) or .paje; "": none
  std::string timeline;  ///< Gantt chart of the only point: .svg or .pdf; "": none
  FilmOptions films;     ///< films of the only point
  bool list = false;
  std::vector<std::string> points;  ///< values of --point: "3" or "3-5", numbered from 0

  bool wants_trace() const { return !trace.empty() || !timeline.empty() || !films.network.empty(); }
  /// True if points must be simulated even if they have results.
  bool runs_anew() const { return profile || wants_trace() || films.is_asked(); }
};

}  // namespace laboratory
