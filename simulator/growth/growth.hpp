#pragma once
// How a picture grew, in numbers and as a moving picture: each picture on the way compared with the
// last one.
#include "simulator/declare/program.hpp"
#include "simulator/growth/recorder.hpp"

namespace growth {

/// Figures of merit of quality (structural similarity with the last picture) over time, s.
struct Figures {
  std::optional<double> area;                       ///< mean quality
  std::optional<double> to_50_s, to_90_s, to_99_s;  ///< from when on it is that share of the last
};
base::Columns<Figures> figure_columns();

struct Growth {
  std::vector<base::Row> rows;  ///< of growth.csv
  Figures figures;
};
/// Empty without pictures. Pictures have `width` pixels a row; `max_cell` is the side of their
/// largest cells.
Growth make_growth(const std::vector<Shown>& pictures, int width, int max_cell);

/// The pictures one after the other, each for as long as it was shown, in MOVIE_S; the last for
/// LAST_S more. As WebP.
programs::Image make_movie(const std::string& name, const std::vector<Shown>& pictures, int width);
inline constexpr double MOVIE_S = 6, LAST_S = 2;

}  // namespace growth
