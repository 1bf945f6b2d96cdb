#include "simulator/iirra/tasks/realism.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/random.hpp"

namespace iirra {

using renderer::Area;

namespace {

constexpr int SAMPLES_OF_LEVEL[] = {0, 5, 9, 13};

bool meets(const SampledCell& cell, const Area& area) {
  return area == Area{} || (cell.x < area.x + area.width && cell.x + cell.side > area.x &&
                            cell.y < area.y + area.height && cell.y + cell.side > area.y);
}

// Returns 1 if the cell overlaps the area of interest. Otherwise returns 1 minus the distance
// between cell and area, divided by the image's diagonal.
double eval_position(const SampledCell& cell, const Area& area, const Area& image) {
  if (meets(cell, area)) return 1;
  const auto gap = [](int a, int a_end, int b, int b_end) {
    return std::max({0, b - a_end, a - b_end});
  };
  const double x = gap(cell.x, cell.x + cell.side, area.x, area.x + area.width);
  const double y = gap(cell.y, cell.y + cell.side, area.y, area.y + area.height);
  return 1 - std::min(1.0, std::sqrt((x * x + y * y) / (double(image.width) * image.width +
                                                        double(image.height) * image.height)));
}

std::uint64_t interleave(std::uint32_t x, std::uint32_t y) {
  std::uint64_t both = 0;
  for (int bit = 0; bit < 17; ++bit)
    both |= static_cast<std::uint64_t>(x >> bit & 1U) << (2 * bit) |
            static_cast<std::uint64_t>(y >> bit & 1U) << (2 * bit + 1);
  return both;
}

}  // namespace

Limits without_limits(const Limits& limits) {
  Limits none;
  none.weights = limits.weights;
  return none;
}

bool is_within(const renderer::Ray& ray, const Limits& limits) {
  const int depth = ray.through ? limits.depth_transmitted : limits.depth_reflected;
  return ray.level <= depth && max_influence(ray) >= limits.min_influence;
}

Advance choose(const SampledCell& cell, const Quantities& quantities, const Limits& limits) {
  if (!meets(cell, limits.area)) return Advance::none;
  Advance finer = Advance::none;
  if (cell.side < limits.min_cell && cell.level > 0) {
    finer = Advance::none;
  } else if (cell.level < last_level(cell)) {
    const bool is_allowed =
        cell.level == 0 || SAMPLES_OF_LEVEL[cell.level + 1] <= limits.max_samples;
    if (is_allowed) finer = Advance::sample;
  } else if (cell.side > 2 && cell.side / 2 >= limits.min_cell &&
             quantities.contrast >= limits.min_contrast) {
    finer = Advance::divide;
  }
  if (quantities.depth == 0) return finer;
  if (finer == Advance::none) return Advance::deepen;
  const bool is_finer = quantities.contrast >= quantities.influence || quantities.pass > 0;
  return is_finer || cell.level == 0 ? finer : Advance::deepen;
}

std::uint64_t eval_bayer(int x, int y, int bits) {
  std::uint64_t element = 0;
  for (int bit = 0; bit < bits; ++bit) {
    const unsigned right = static_cast<unsigned>(x) >> bit & 1U;
    const unsigned down = static_cast<unsigned>(y) >> bit & 1U;
    element = element << 2 | (right ^ down) << 1 | down;
  }
  return element;
}

CellQuadrants make_cell_quadrants(const Area& image, int max_cell) {
  CellQuadrants quadrants;
  for (int side = max_cell; side >= 2; side /= 2) {
    // The number of cells with this side in a row or column. Includes cells outside the image that
    // result from dividing a largest cell on the border.
    const auto cells = [&](int pixels) {
      return (pixels + max_cell - 1) / max_cell * (max_cell / side);
    };
    quadrants[side] =
        renderer::progressive::make_order({0, 0, cells(image.width), cells(image.height)});
  }
  return quadrants;
}

namespace {

// Returns a sort key for cells of equal importance; the lowest comes first.
std::uint64_t eval_place(const Ordering& o, const SampledCell& cell, double contrast) {
  const int column = (cell.x - o.image.x) / cell.side, row = (cell.y - o.image.y) / cell.side;
  const auto drawn = [&] {
    return base::random_at(
        o.seed, interleave(static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y)));
  };
  if (o.quadrants) {
    const auto& of_size = o.quadrants->at(cell.side);
    const auto columns = static_cast<std::size_t>(of_size.quadrants[0].width);
    return of_size
        .ranks[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)];
  }
  switch (o.order) {
    case CellOrder::bayer:
      return eval_bayer(column, row, 16);
    case CellOrder::random:
      return drawn();
    case CellOrder::sequential:
      return static_cast<std::uint64_t>(row) << 32 | static_cast<std::uint32_t>(column);
    case CellOrder::recursive:
      return interleave(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    case CellOrder::adaptive:
      // The upper 10 bits order cells by falling contrast, and the lower 54 bits are random.
      return static_cast<std::uint64_t>(1023 * (1 - contrast)) << 54 | drawn() >> 10;
  }
  return 0;
}

}  // namespace

Importance Ordering::eval(const SampledCell& cell, const Quantities& quantities,
                          const Limits& limits) const {
  const Weights w = limits.weights.value_or(weights);
  const auto log2 = [](int side) { return std::countr_zero(static_cast<unsigned>(side)); };
  Importance importance;
  importance.sum = w.position * eval_position(cell, limits.area, image) +
                   w.size * log2(cell.side) / std::max(1, log2(max_cell)) +
                   w.samples * (1 - SAMPLES_OF_LEVEL[cell.level] / 13.0) +
                   w.contrast * quantities.contrast + w.influence * quantities.influence;
  if (quantities.depth > 0) importance.sum += w.depth / quantities.depth;
  importance.place = eval_place(*this, cell, quantities.contrast);
  return importance;
}

}  // namespace iirra
