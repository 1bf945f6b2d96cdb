#pragma once
// Films of a run: the growing picture, and the machine with its loads.
#include <optional>
#include <string>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/film/film_options.hpp"
#include "experiments/laboratory/film/machine_drawing.hpp"
#include "renderer/image/animation.hpp"
#include "simulator/observe/trace.hpp"
#include "simulator/snapshots/recorder.hpp"

namespace laboratory {

/// Duration of a film, and additional duration of its last frame.
inline constexpr int FILM_MS = 10000, LAST_MS = 2000;

/// The file of a frame, from 0: "film-0001.png" for "film.png".
std::string frame_name(const std::string& file, std::size_t frame);

/// The file of a film, or its first and last frame files: "f-0001.png to f-0100.png".
std::string describe_files(const std::string& file, int frames);

/// The first file to be written: the film, or its first frame. Throws BadInput for endings other
/// than .webp and .png.
std::string first_file(const std::string& file);

/// Throws BadInput for a film of a picture if the program shows none, and for a film of a network
/// that is missing or too large to draw.
void check_films(const FilmOptions& options, const Experiment& experiment);

/// The position of a picture in the frames of its film, in pixels, and the side of the square that
/// shows one of its pixels.
struct PicturePlace {
  int x, y, factor, width, height;  ///< width and height of a frame
};
PicturePlace place_picture(int width, int height);

/// Records a run to make films of it.
class Film : public observe::RunObserver {
 public:
  /// Films begin `from_s` seconds after the start of the program. `network`: the program's
  /// topology, if a film shows it.
  Film(const FilmOptions& options, const topologies::Topology& network, double from_s);

  /// Throws BadInput for a picture too large for a film of that many frames.
  void begin(const machine::Machine& machine, const observe::ControlPanel& view) override;
  void before_change(double now_s) override;
  void end(double now_s) override;

  /// Writes the requested films, up to `end`. `trace` covers the same interval; `title` is drawn
  /// above. Throws BadInput if there was no machine, and if the run ended before the films begin.
  void save(const std::string& title, const observe::Trace& trace) const;

 private:
  snapshots::Snapshot look() const;
  void save_picture(const std::string& title) const;
  void save_network(const std::string& title, const observe::Trace& trace) const;

  const FilmOptions options_;
  const topologies::Topology network_;
  const double from_s_;
  double end_s_ = 0;                                       // of the run
  std::optional<snapshots::Recorder> recorder_;            // of the picture
  std::optional<observe::ControlPanel::Picture> picture_;  // while the machine runs
  int width_ = 0;                                          // of the picture
  std::optional<MachineDrawing> drawing_;
};

}  // namespace laboratory
