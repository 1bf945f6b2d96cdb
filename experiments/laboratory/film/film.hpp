#pragma once
// Films of a run: its picture as it grows, and its machine with how busy everything was.
#include <optional>
#include <string>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/film/film_options.hpp"
#include "experiments/laboratory/film/machine_drawing.hpp"
#include "renderer/image/animation.hpp"
#include "simulator/growth/recorder.hpp"
#include "simulator/observe/trace.hpp"

namespace laboratory {

/// What a film takes to show, with LAST_MS more for its last frame.
inline constexpr int FILM_MS = 10000, LAST_MS = 2000;

/// "film.png" as the file of a frame, from 0: "film-0001.png".
std::string frame_name(const std::string& file, std::size_t frame);

/// The file of a film, or the first and the last of its frames': "f-0001.png to f-0100.png".
std::string describe_files(const std::string& file, int frames);

/// The file that is written first: the film's, or that of its first frame. Throws BadInput for
/// another ending than .webp and .png.
std::string first_file(const std::string& file);

/// Throws BadInput for films that the experiment has not: of a program that shows no picture, or
/// has no network, or one too large to draw.
void check_films(const FilmOptions& options, const Experiment& experiment);

/// Where a picture is in the frames of its film: pixels, and the side of a square that shows one of
/// its pixels.
struct PicturePlace {
  int x, y, factor, width, height;  ///< width and height of a frame
};
PicturePlace place_picture(int width, int height);

/// Follows a run to make films of it.
class Film : public observe::Onlooker {
 public:
  /// Films begin at `from_s`, s, from the start of the program. `network`: the topology on which
  /// the program runs, if there is to be a film of it.
  Film(const FilmOptions& options, const topologies::Topology& network, double from_s);

  /// Throws BadInput for a picture that is too large for a film of so many frames.
  void begin(const machine::Machine& machine, const observe::View& view) override;
  void before_change(double now_s) override;
  void end(double now_s) override;

  /// Writes the films that are asked for, of what happened until `end`. `trace` is of the same
  /// window, `title` stands above. Throws BadInput where there was no machine, and where the run
  /// has ended before the films begin.
  void save(const std::string& title, const observe::Trace& trace) const;

 private:
  growth::Shown look() const;
  void save_picture(const std::string& title) const;
  void save_network(const std::string& title, const observe::Trace& trace) const;

  const FilmOptions options_;
  const topologies::Topology network_;
  const double from_s_;
  double end_s_ = 0;                               // of the run
  std::optional<growth::Recorder> recorder_;       // of the picture
  std::optional<observe::View::Picture> picture_;  // while the machine runs
  int width_ = 0;                                  // of it
  std::optional<MachineDrawing> drawing_;
};

}  // namespace laboratory
