#pragma once
// Increasing realism in IIRRA (thesis, 5.1.3 and 5.3): the six quantities of an image cell, the
// user's limits to them, what is done next with a cell, and in which order cells come.
#include <map>
#include <memory>
#include <optional>

#include "renderer/progressive/quadrants.hpp"
#include "renderer/progressive/sampled_cell.hpp"

namespace iirra {

using renderer::progressive::SampledCell;

/// What a cell's quantities weigh in its importance, at least 0; each is between 0 and 1.
struct Weights {
  double position = 1;   ///< 1 within the area of interest, less the farther away
  double size = 4;       ///< log2 of the side, of that of the largest cell
  double samples = 2;    ///< 1 without samples, 0 with 13
  double contrast = 1;   ///< Eq 4.7
  double depth = 1;      ///< 1 over the least tree level that waits
  double influence = 1;  ///< the largest influence factor of a ray that waits
  bool operator==(const Weights&) const = default;
};

/// The user's parameters. An advance of a cell that would take a quantity beyond its limit waits
/// for the non-interactive phase.
struct Limits {
  double min_influence = 0.0;      ///< influence factor of a ray, at least
  int depth_reflected = 1000;      ///< level, at most, of rays with only reflections before them
  int depth_transmitted = 1000;    ///< level, at most, of transmitted rays and their descendants
  int min_cell = 2;                ///< pixels, side of a cell, at least
  int max_samples = 13;            ///< of a cell, at most
  double min_contrast = 0.0;       ///< of a cell that is divided, at least
  renderer::Area area;             ///< pixels of interest, of which a cell has one; 0 x 0: all
  std::optional<Weights> weights;  ///< none: the program's
  bool operator==(const Limits&) const = default;
};

/// The limits of the non-interactive phase: none, with the same order.
Limits without_limits(const Limits& limits);

/// A ray that waits is within the limits.
bool is_within(const renderer::Ray& ray, const Limits& limits);

/// What decides about a cell, beside where it is and how large.
struct Quantities {
  double contrast = 0;
  int depth = 0;         ///< least tree level of the rays of `pass` that wait; 0: none does
  double influence = 0;  ///< largest influence factor of these
  int pass = 0;          ///< the earliest of pixels' samples that a ray within the limits waits for
};

enum class Advance : std::uint8_t {
  none,    ///< every one is beyond the limits: the cell waits for others
  sample,  ///< the next level of sampling
  divide,  ///< into four
  deepen   ///< the next level of the samples' shading trees
};

/// What is done next with a cell: resolution as long as its contrast is at least the influence of
/// the rays that wait, since that much of its light is not where it belongs yet; else depth. What
/// waits for a second sample of a pixel comes last.
Advance choose(const SampledCell& cell, const Quantities& quantities, const Limits& limits);

/// The order of cells of one importance.
enum class CellOrder : std::uint8_t {
  bayer,       ///< by the matrix of Eq 5.7, of any order
  random,      ///< drawn from a seed
  sequential,  ///< rows from the top
  recursive,   ///< quadrants of quadrants
  adaptive     ///< the greatest contrast first; then as random
};

/// The element of B. Bayer's matrix (1973) of order 2^bits, from 0; Eq 5.7, which counts from 1, is
/// that of 2 bits. Column x, row y.
std::uint64_t eval_bayer(int x, int y, int bits);

/// The sum of weighted quantities, and the place among equals.
struct Importance {
  double sum = 0;
  std::uint64_t place = 0;
};

/// The quadrant's rank of every cell of a size, by the cells' side; cells are counted from the
/// image's upper left.
using CellQuadrants = std::map<int, renderer::progressive::QuadrantOrder>;
CellQuadrants make_cell_quadrants(const renderer::Area& image, int max_cell);

/// Where cells are judged: the image and its largest cells.
struct Ordering {
  renderer::Area image;  ///< pixels, of which the first cell is at the upper left
  int max_cell = 16;
  CellOrder order = CellOrder::bayer;
  std::uint64_t seed = 1;
  Weights weights;                                           ///< where limits have none
  std::shared_ptr<const CellQuadrants> quadrants = nullptr;  ///< in place of `order`

  Importance eval(const SampledCell& cell, const Quantities& quantities,
                  const Limits& limits) const;
};

}  // namespace iirra
