#pragma once
// Quality of a growing picture over time, as numbers and as an animation. Each intermediate picture
// is compared with the final one.
#include "simulator/programs/declare/program.hpp"
#include "simulator/snapshots/recorder.hpp"

namespace snapshots {

/// Summary of the quality over time. Quality is the structural similarity to the final picture.
struct Figures {
  std::optional<double> area;  ///< mean quality during the run, 0 to 1
  /// Seconds after which the quality remains at or above 50, 90 and 99 %.
  std::optional<double> to_50_s, to_90_s, to_99_s;
};
base::Columns<Figures> figure_columns();

struct QualityCurve {
  std::vector<base::Row> rows;  ///< rows of growth.csv
  Figures figures;
};
/// Compares each picture with the last one. Without pictures, the result is empty. `width` is the
/// width of the image, `max_cell` the side of the largest image cells, both in pixels.
QualityCurve make_quality_curve(const std::vector<Snapshot>& pictures, int width, int max_cell);

/// Makes an animation in WebP format. It lasts MOVIE_S seconds, in which each picture is shown in
/// proportion to its time on the display, plus LAST_S seconds for the last picture.
programs::Image make_movie(const std::string& name, const std::vector<Snapshot>& pictures,
                           int width);
inline constexpr double MOVIE_S = 6, LAST_S = 2;

}  // namespace snapshots
