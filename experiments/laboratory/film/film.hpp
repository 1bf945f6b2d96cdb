#pragma once
// Films of a run: one shows the picture as it grows, the other the machine with its loads.
#include <optional>
#include <string>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/film/machine_drawing.hpp"
#include "experiments/laboratory/points/run_options.hpp"
#include "renderer/image/animation.hpp"
#include "simulator/observe/trace.hpp"
#include "simulator/snapshots/recorder.hpp"

namespace laboratory {

/// Duration of a film, and the additional time for which its last frame is shown, in ms.
inline constexpr int FILM_MS = 10000, LAST_MS = 2000;

/// The file name of the frame with index `frame`, counted from 0. The numbers in file names count
/// from 1: the first frame of "film.png" is "film-0001.png".
std::string frame_name(const std::string& file, std::size_t frame);

/// Describes the output for a message: the file of the film, or the first and last file of its
/// frames, as in "f-0001.png to f-0100.png".
std::string describe_files(const std::string& file, int frames);

/// The first file that will be written: the film, or its first frame. Throws BadInput for an
/// extension other than .webp and .png.
std::string first_file(const std::string& file);

/// Throws BadInput for a film of the picture if the program has no picture, and for a film of the
/// network if there is no network or it is too large to draw.
void check_films(const FilmOptions& options, const Experiment& experiment);

/// Position of the picture in a frame, in pixels. Each pixel of the picture becomes a square with
/// the side `factor`.
struct PicturePlace {
  /// `x` and `y` of the picture's upper left corner; `width` and `height` of the frame
  int x, y, factor, width, height;
};
PicturePlace place_picture(int width, int height);

/// Observer that records a simulation in order to make films of it.
class Film : public observe::RunObserver {
 public:
  /// Records films that begin `from_s` simulated seconds after the start of the program. `network`
  /// is the program's topology, used only for a film of the network.
  Film(const FilmOptions& options, const topologies::Topology& network, double from_s);

  /// Throws BadInput if the samples of the picture would exceed the memory limit, or if drawing the
  /// frames takes minutes and the user has not confirmed it.
  void begin(const machine::Machine& machine, const observe::ControlPanel& view) override;
  void before_change(double now_s) override;
  void end(double now_s) override;

  /// True if the run has reached the time at which films begin.
  bool has_begun() const { return from_s_ < end_s_; }
  /// Writes the requested films, from `from_s` to the end of the run. `trace` must cover the same
  /// interval. `title` is drawn above each frame. Throws BadInput if no machine was simulated, or
  /// if the run ended before `from_s`.
  void save(const std::string& title, const observe::Trace& trace) const;

 private:
  snapshots::Snapshot look() const;
  void save_picture(const std::string& title) const;
  void save_network(const std::string& title, const observe::Trace& trace) const;

  const FilmOptions options_;
  const topologies::Topology network_;
  const double from_s_;
  double end_s_ = 0;                             // simulated time at the end of the run
  std::optional<snapshots::Recorder> recorder_;  // samples of the picture
  // access to the program's current picture, valid while the machine runs
  std::optional<observe::ControlPanel::Picture> picture_;
  int width_ = 0;  // width of the program's picture, pixels
  std::optional<MachineDrawing> drawing_;
};

}  // namespace laboratory
