#pragma once
// Increasing realism in IIRRA (thesis, 5.1.3 and 5.3): six quantities of an image cell, the user's
// limits on them, the choice of a cell's next step, and the order of cells.
#include <map>
#include <memory>
#include <optional>

#include "renderer/progressive/quadrants.hpp"
#include "renderer/progressive/sampled_cell.hpp"

namespace iirra {

using renderer::progressive::SampledCell;

/// Weights of a cell's quantities in its importance, at least 0. Each quantity lies in [0, 1].
struct Weights {
  double position = 1;   ///< 1 within the area of interest, decreasing with distance
  double size = 4;       ///< log2 of the side divided by that of the largest cell
  double samples = 2;    ///< 1 without samples, 0 with 13 samples
  double contrast = 1;   ///< Eq 4.7
  double depth = 1;      ///< 1 / lowest level of a waiting ray in its shading tree
  double influence = 1;  ///< largest influence factor of a waiting ray
  bool operator==(const Weights&) const = default;
};

/// The user's parameters of increasing realism. A step of a cell that exceeds a limit must wait for
/// the non-interactive phase.
struct Limits {
  double min_influence = 0.0;      ///< minimum influence factor of a ray
  int depth_reflected = 1000;      ///< maximum level of rays that follow only reflections
  int depth_transmitted = 1000;    ///< maximum level of transmitted rays and their descendants
  int min_cell = 2;                ///< minimum side of a cell in pixels
  int max_samples = 13;            ///< maximum number of samples in a cell
  double min_contrast = 0.0;       ///< minimum contrast at which a cell is divided
  renderer::Area area;             ///< pixels that a cell must overlap; 0 x 0 for all
  std::optional<Weights> weights;  ///< if absent, those of the program
  bool operator==(const Limits&) const = default;
};

/// The limits of the non-interactive phase, which admit everything and keep the weights.
Limits without_limits(const Limits& limits);

/// True if a waiting ray is within the limits.
bool is_within(const renderer::Ray& ray, const Limits& limits);

/// The quantities that determine a cell's next step, besides its position and size.
struct Quantities {
  double contrast = 0;
  int depth = 0;         ///< lowest level of waiting rays of `pass`; 0 if none is waiting
  double influence = 0;  ///< largest influence factor of these rays
  int pass = 0;          ///< earliest sample number with a waiting ray within the limits
};

enum class Advance : std::uint8_t {
  none,    ///< no step is within the limits; the cell waits for new limits
  sample,  ///< take the samples of the next level
  divide,  ///< divide the cell into four
  deepen   ///< trace the next level of the samples' shading trees
};

/// Chooses a cell's next step. Refines the resolution while the contrast is at least the influence
/// of waiting rays; otherwise deepens the shading trees. The contrast estimates the light that the
/// present resolution still misplaces. Second and later samples of pixels come last.
Advance choose(const SampledCell& cell, const Quantities& quantities, const Limits& limits);

/// The order of cells with equal importance.
enum class CellOrder : std::uint8_t {
  bayer,       ///< Bayer's matrix of Eq 5.7, extended to arbitrary order
  random,      ///< shuffled, depending on a seed
  sequential,  ///< row by row from the top
  recursive,   ///< recursive quadrants
  adaptive     ///< highest contrast first, then random
};

/// The element at column x and row y, both from 0, of Bayer's matrix (B. Bayer, 1973) of order
/// 2^bits. Elements count from 0. Eq 5.7 shows the matrix for 2 bits, with elements from 1.
std::uint64_t eval_bayer(int x, int y, int bits);

/// The importance of a cell: the weighted sum of its quantities, and its rank among cells with
/// equal sums.
struct Importance {
  double sum = 0;
  std::uint64_t place = 0;
};

/// Quadrant order of cells, by side length. The orders count coordinates in cells from the upper
/// left corner of the image.
using CellQuadrants = std::map<int, renderer::progressive::QuadrantOrder>;
CellQuadrants make_cell_quadrants(const renderer::Area& image, int max_cell);

/// Parameters that determine the importance of cells.
struct Ordering {
  renderer::Area image;  ///< in pixels; the first cell is at the upper left
  int max_cell = 16;
  CellOrder order = CellOrder::bayer;
  std::uint64_t seed = 1;
  Weights weights;                                           ///< used if the limits have no weights
  std::shared_ptr<const CellQuadrants> quadrants = nullptr;  ///< replaces `order` if set

  Importance eval(const SampledCell& cell, const Quantities& quantities,
                  const Limits& limits) const;
};

}  // namespace iirra
