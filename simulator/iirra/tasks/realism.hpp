#pragma once
// Increasing realism in IIRRA (thesis, 5.1.3 and 5.3): six measured quantities of an image cell,
// the user's limits on them, the choice of a cell's next step, and the order of refining cells.
#include <map>
#include <memory>
#include <optional>

#include "renderer/progressive/quadrants.hpp"
#include "renderer/progressive/sampled_cell.hpp"

namespace iirra {

using renderer::progressive::SampledCell;

/// Weights of six quantities in a cell's importance. Each weight is at least 0; each quantity lies
/// in [0, 1].
struct Weights {
  double position = 1;   ///< 1 within the area of interest, decreasing with distance
  double size = 4;       ///< log2 of the cell's side divided by log2 of the largest cell's side
  double samples = 2;    ///< 1 without samples, 0 with 13 samples
  double contrast = 1;   ///< contrast between the cell's samples (thesis, Eq 4.7)
  double depth = 1;      ///< 1 / lowest level at which a ray waits; primary rays have level 1
  double influence = 1;  ///< largest influence factor of the waiting rays
  bool operator==(const Weights&) const = default;
};

/// Limits of increasing realism, set by the user. A step of a cell that exceeds a limit waits for
/// the non-interactive phase.
struct Limits {
  double min_influence = 0.0;  ///< minimum influence factor of a ray
  /// Maximum level in the shading tree of rays that follow only reflections.
  int depth_reflected = 1000;
  int depth_transmitted = 1000;    ///< maximum level of transmitted rays and of their descendants
  int min_cell = 2;                ///< minimum side of a cell in pixels
  int max_samples = 13;            ///< maximum number of samples in a cell
  double min_contrast = 0.0;       ///< minimum contrast at which a cell is divided
  renderer::Area area;             ///< pixels that a cell must overlap; 0 x 0 for all
  std::optional<Weights> weights;  ///< if absent, the weights in the program's parameters apply
  bool operator==(const Limits&) const = default;
};

/// Returns the limits of the non-interactive phase: they admit every step, with the weights of
/// `limits`.
Limits without_limits(const Limits& limits);

/// True if a waiting ray may be traced under the limits.
bool is_within(const renderer::Ray& ray, const Limits& limits);

/// Quantities that determine a cell's next step, in addition to its position and size.
struct Quantities {
  double contrast = 0;
  int depth = 0;  ///< lowest tree level of the waiting rays of sample `pass`; 0 if none waits
  double influence = 0;  ///< largest influence factor of the waiting rays of sample `pass`
  int pass = 0;  ///< lowest sample number of a pixel that has a waiting ray within the limits
};

enum class Advance : std::uint8_t {
  none,    ///< no step is within the limits; the cell waits for new limits
  sample,  ///< take the samples of the cell's next sampling level
  divide,  ///< divide the cell into four
  deepen   ///< trace the next level of the shading trees of the cell's samples
};

/// Chooses a cell's next step. While the contrast is at least the influence factor of the waiting
/// rays, takes more samples or divides the cell; otherwise traces the waiting rays. The contrast
/// serves as an estimate of the error caused by the present resolution. Second and later samples of
/// pixels come last.
Advance choose(const SampledCell& cell, const Quantities& quantities, const Limits& limits);

/// The order of refining cells of equal importance.
enum class CellOrder : std::uint8_t {
  bayer,       ///< by Bayer's dither matrix (thesis, Eq 5.7), extended to any power of two
  random,      ///< random, determined by a seed
  sequential,  ///< row by row from the top
  recursive,   ///< recursively by quadrants
  adaptive     ///< by falling contrast, then random
};

/// Returns the element at column x and row y, both counted from 0, of Bayer's dither matrix (B.
/// Bayer, 1973) with 2^bits rows. Elements are numbered from 0. Eq 5.7 of the thesis shows the
/// matrix for 2 bits, with elements numbered from 1.
std::uint64_t eval_bayer(int x, int y, int bits);

/// The importance of a cell: the weighted sum of its quantities, and its place among cells with
/// equal sums (lowest first).
struct Importance {
  double sum = 0;
  std::uint64_t place = 0;
};

/// For each side length of cells in pixels, the order in which cells of this size are processed,
/// quadrant by quadrant. A cell's column and row are counted in cells of this size, from the upper
/// left corner of the image.
using CellQuadrants = std::map<int, renderer::progressive::QuadrantOrder>;
CellQuadrants make_cell_quadrants(const renderer::Area& image, int max_cell);

/// Parameters that determine the importance of a cell.
struct Ordering {
  renderer::Area image;  ///< computed area in pixels; the first cell is at its upper left
  int max_cell = 16;
  CellOrder order = CellOrder::bayer;
  std::uint64_t seed = 1;
  Weights weights;  ///< apply if the limits have no weights
  std::shared_ptr<const CellQuadrants> quadrants = nullptr;  ///< replaces `order` if set

  Importance eval(const SampledCell& cell, const Quantities& quantities,
                  const Limits& limits) const;
};

}  // namespace iirra
