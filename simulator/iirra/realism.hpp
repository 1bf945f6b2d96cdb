#pragma once
// Increasing realism in IIRRA (thesis, 5.1.3 and 5.3): six quantities of an image cell, the user's
// limits to them, the choice of a cell's next step, and the order of cells.
#include <map>
#include <memory>
#include <optional>

#include "renderer/progressive/quadrants.hpp"
#include "renderer/progressive/sampled_cell.hpp"

namespace iirra {

using renderer::progressive::SampledCell;

/// Weights of a cell's quantities in its importance, at least 0; each quantity lies in [0, 1].
struct Weights {
  double position = 1;   ///< 1 within the area of interest, decreasing with distance
  double size = 4;       ///< log2 of the side, relative to the largest cell
  double samples = 2;    ///< 1 without samples, 0 with 13 samples
  double contrast = 1;   ///< Eq 4.7
  double depth = 1;      ///< 1 / lowest tree level of a waiting ray
  double influence = 1;  ///< largest influence factor of a waiting ray
  bool operator==(const Weights&) const = default;
};

/// The user's parameters. A step of a cell that would exceed a limit waits for the non-interactive
/// phase.
struct Limits {
  double min_influence = 0.0;      ///< smallest influence factor of a ray
  int depth_reflected = 1000;      ///< highest level of rays with only reflections before them
  int depth_transmitted = 1000;    ///< highest level of transmitted rays and their descendants
  int min_cell = 2;                ///< smallest side of a cell, pixels
  int max_samples = 13;            ///< most samples of a cell
  double min_contrast = 0.0;       ///< smallest contrast at which a cell is divided
  renderer::Area area;             ///< pixels of interest; a cell must overlap them; 0 x 0: all
  std::optional<Weights> weights;  ///< none: the program's
  bool operator==(const Limits&) const = default;
};

/// Limits of the non-interactive phase: none, but the same weights.
Limits without_limits(const Limits& limits);

/// True if a waiting ray is within the limits.
bool is_within(const renderer::Ray& ray, const Limits& limits);

/// State of a cell that decides its next step, beside its position and size.
struct Quantities {
  double contrast = 0;
  int depth = 0;         ///< lowest tree level of waiting rays of `pass`; 0: none waits
  double influence = 0;  ///< largest influence factor of those rays
  int pass = 0;          ///< earliest sample number of a pixel with a waiting ray within the limits
};

enum class Advance : std::uint8_t {
  none,    ///< all steps are beyond the limits: the cell waits for new ones
  sample,  ///< the next level of sampling
  divide,  ///< into four
  deepen   ///< trace the next level of the samples' shading trees
};

/// Chooses a cell's next step. Refines resolution while the contrast is at least the influence of
/// waiting rays, since that much light is still misplaced; else deepens. Rays of second and later
/// samples of a pixel come last.
Advance choose(const SampledCell& cell, const Quantities& quantities, const Limits& limits);

/// Order of cells of equal importance.
enum class CellOrder : std::uint8_t {
  bayer,       ///< Bayer's matrix of Eq 5.7, extended to any order
  random,      ///< shuffled by a seed
  sequential,  ///< row by row from the top
  recursive,   ///< quadrants of quadrants
  adaptive     ///< greatest contrast first, then random
};

/// Element of B. Bayer's matrix (1973) of order 2^bits at column x, row y, from 0. Eq 5.7 is the
/// matrix of 2 bits, counted from 1.
std::uint64_t eval_bayer(int x, int y, int bits);

/// Weighted sum of quantities, and the rank among equal sums.
struct Importance {
  double sum = 0;
  std::uint64_t place = 0;
};

/// Quadrant order of the cells of each size, by side. Cells count from the image's upper left.
using CellQuadrants = std::map<int, renderer::progressive::QuadrantOrder>;
CellQuadrants make_cell_quadrants(const renderer::Area& image, int max_cell);

/// Parameters of a cell's importance.
struct Ordering {
  renderer::Area image;  ///< pixels; the first cell is at its upper left
  int max_cell = 16;
  CellOrder order = CellOrder::bayer;
  std::uint64_t seed = 1;
  Weights weights;                                           ///< if the limits have none
  std::shared_ptr<const CellQuadrants> quadrants = nullptr;  ///< if set, replaces `order`

  Importance eval(const SampledCell& cell, const Quantities& quantities,
                  const Limits& limits) const;
};

}  // namespace iirra
