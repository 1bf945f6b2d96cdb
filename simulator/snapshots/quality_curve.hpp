#pragma once
// Quality of a growing picture as numbers and as an animation. Each intermediate picture is
// compared with the final one.
#include "simulator/programs/declare/program.hpp"
#include "simulator/snapshots/recorder.hpp"

namespace snapshots {

/// Quality over time, where quality is the structural similarity to the final picture.
struct Figures {
  std::optional<double> area;                       ///< mean quality over the run
  std::optional<double> to_50_s, to_90_s, to_99_s;  ///< seconds to 50, 90, 99 % quality
};
base::Columns<Figures> figure_columns();

struct QualityCurve {
  std::vector<base::Row> rows;  ///< rows of growth.csv
  Figures figures;
};
/// Compares each picture with the last one. Returns an empty result without pictures. `width` is
/// the image width and `max_cell` the side of the largest cells, both in pixels.
QualityCurve make_quality_curve(const std::vector<Snapshot>& pictures, int width, int max_cell);

/// Makes an animation in WebP that lasts MOVIE_S seconds. Each picture is shown in proportion to
/// its actual time on the display. The last picture stays LAST_S seconds longer.
programs::Image make_movie(const std::string& name, const std::vector<Snapshot>& pictures,
                           int width);
inline constexpr double MOVIE_S = 6, LAST_S = 2;

}  // namespace snapshots
