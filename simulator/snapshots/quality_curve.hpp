#pragma once
// QualityCurve of a picture, in numbers and as an animation: each intermediate picture is compared
// with the last one.
#include "simulator/programs/declare/program.hpp"
#include "simulator/snapshots/recorder.hpp"

namespace snapshots {

/// Figures of merit of quality (structural similarity with the last picture) over time, s.
struct Figures {
  std::optional<double> area;                       ///< mean quality
  std::optional<double> to_50_s, to_90_s, to_99_s;  ///< time until 50, 90, 99 % of the last's
};
base::Columns<Figures> figure_columns();

struct QualityCurve {
  std::vector<base::Row> rows;  ///< rows of growth.csv
  Figures figures;
};
/// Compares pictures with the last one; empty without pictures. `width`: pixels per row;
/// `max_cell`: side of the largest cells in pixels.
QualityCurve make_quality_curve(const std::vector<Snapshot>& pictures, int width, int max_cell);

/// Makes an animation in WebP. It lasts MOVIE_S, each picture in proportion to the time it was
/// shown; the last picture stays for LAST_S more.
programs::Image make_movie(const std::string& name, const std::vector<Snapshot>& pictures,
                           int width);
inline constexpr double MOVIE_S = 6, LAST_S = 2;

}  // namespace snapshots
