#pragma once
// Image cells (thesis, 4.3.2 and 4.3.7): squares whose upper left pixel is sampled first; how
// samples paint their cells, and the order of cells.
#include <memory>
#include <optional>
#include <vector>

#include "renderer/progressive/quadrants.hpp"
#include "renderer/trace/render.hpp"
#include "renderer/trace/shade.hpp"

namespace farm {

/// The order of cells of one size (thesis, 4.3.7).
enum class CellOrder : std::uint8_t {
  random,      ///< shuffled by a seed
  sequential,  ///< from top to bottom, from left to right
  recursive,   ///< as quadrants of quadrants: upper left, upper right, lower left, lower right
  adaptive     ///< random; a cell exists once the cell it divides is sampled, and precedes cells up
               ///< to four times as large if that sample's object differs from a neighbour's
};

/// Squares of `max_cell` pixels (a power of two) tile the image from pixel (x, y). Each divides
/// into four smaller ones, down to single pixels. A sample lies at the upper left corner of one or
/// several cells and belongs to the largest.
struct Cells {
  int width = 100;  ///< width of the image, pixels
  int max_cell = 16;
  int x = 0, y = 0;  ///< upper left pixel of the first cell
  CellOrder order = CellOrder::random;
  /// If set, replaces squares: each sample's cell is a quadrant, placed by its rank, of size 1.
  std::shared_ptr<const renderer::progressive::QuadrantOrder> quadrants = nullptr;

  int size_of(std::uint32_t sample) const;
  /// Place of a sample among cells of one size; 0 if the order is random.
  std::uint64_t place_of(std::uint32_t sample) const;
  /// Fineness number of the sample's cell: lower than that of any larger cell that it overlaps.
  std::uint32_t fineness_of(std::uint32_t sample) const;
  /// The part of the sample's cell that lies within `limit`.
  renderer::Area area_of(std::uint32_t sample, const renderer::Area& limit) const;
  /// Samples of the cells into which the cell of `sample` divides, down to single pixels, within
  /// `limit`. Each sample not of size max_cell belongs to exactly one such cell.
  std::vector<std::uint32_t> divide(std::uint32_t sample, const renderer::Area& limit) const;
  /// The place of a sample in the queue of quadrants.
  std::uint32_t rank_of(std::uint32_t sample) const;
};

/// Primary rays in order of deposit: from the largest cells to the smallest, each size in its own
/// order. CellOrder::adaptive: only the largest cells.
std::vector<renderer::Ray> make_initial_rays(const renderer::Scene& scene,
                                             const renderer::Params& params, const Cells& cells,
                                             std::uint64_t seed);

/// How a sample paints its cell (thesis, 4.3.7).
enum class CellLight : std::uint8_t {
  constant,  ///< the whole cell has the sample's colour
  point,     ///< only the sample's pixel is lit
  smooth     ///< bilinear between the samples at the cell's corners, if known
};

/// Final sums of a complete adaptive pixel with samples of unequal weight.
struct FinishedPixel {
  std::uint32_t sample = 0;      ///< y * width + x
  renderer::Samples::Sums sums;  ///< eval_estimate() times the number of the pixel's samples
};

/// The display's growing picture. A pixel shows the smallest sampled cell around it, or else the
/// background (black by default). With all samples it equals the image.
class FrameBuffer {
 public:
  FrameBuffer() = default;
  /// Paints cells only within `area`; 0 x 0: everywhere.
  FrameBuffer(int width, int height, Cells cells, CellLight light, renderer::Area area = {},
              const renderer::Sampling& sampling = {});

  /// Adds a ray's contribution to its sample and paints the change. A pixel shows the mean of its
  /// samples whose primary ray has arrived. Returns whether any pixel of the picture changed.
  bool add(const renderer::Ray& ray, const renderer::Rgb& contribution, renderer::Work& work);
  /// Replaces the sums of a complete adaptive pixel and paints the change.
  void finish(const FinishedPixel& finished, renderer::Work& work);
  /// Sets the picture under pixels without a sampled cell; same size as this one.
  void set_background(std::vector<std::uint8_t> rgb8) { rgb8_ = std::move(rgb8); }
  /// Adds a block of complete samples.
  void add(const renderer::Block& block, renderer::Work& work);

  /// The samples, equal to those of render() once all have arrived.
  renderer::Samples samples() const;
  /// Rows from the top, 3 bytes a pixel, in the format of renderer::make_rgb8.
  const std::vector<std::uint8_t>& rgb8() const { return rgb8_; }

 private:
  static constexpr auto NOBODY = std::numeric_limits<std::uint32_t>::max();
  bool is_sampled(std::uint32_t sample) const;
  int size_now(std::uint32_t sample) const;
  void own(std::uint32_t sample);
  bool paint_all(std::uint32_t sample, renderer::Work& work);
  bool paint(std::uint32_t sample, renderer::Work& work);
  bool paint_neighbours(std::uint32_t sample, renderer::Work& work);
  renderer::Rgb colour_of(std::uint32_t sample) const;
  renderer::Rgb eval_smooth(std::uint32_t sample, int x, int y) const;
  bool draw(std::size_t pixel, const std::array<std::uint8_t, 3>& colour);

  Cells cells_;
  CellLight light_ = CellLight::constant;
  int width_ = 0;
  renderer::Area area_;
  renderer::Sampling sampling_;
  renderer::Samples samples_;
  std::vector<std::uint16_t> counts_;  // samples of each pixel, if more than one
  std::vector<std::uint32_t> owner_;   // fineness of the cell shown at each pixel
  std::vector<std::uint8_t> rgb8_;
};

}  // namespace farm
