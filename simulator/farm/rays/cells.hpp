#pragma once
// Image cells (thesis, 4.3.2 and 4.3.7): squares whose upper left pixel is sampled first. Defines
// the order of cells and how samples paint them.
#include <memory>
#include <optional>
#include <vector>

#include "renderer/progressive/quadrants.hpp"
#include "renderer/trace/render.hpp"
#include "renderer/trace/shade.hpp"

namespace farm {

/// The order of cells of equal size (thesis, 4.3.7).
enum class CellOrder : std::uint8_t {
  random,      ///< shuffled, depending on a seed
  sequential,  ///< from top to bottom, each row from left to right
  recursive,   ///< recursive quadrants: upper left, upper right, lower left, lower right
  /// Random order; a cell exists only after its parent has been sampled. If the parent's sample
  /// shows another object than a neighbour's, the cell precedes cells up to four times as large.
  adaptive
};

/// Tiling of the image by squares of `max_cell` pixels (a power of two) from pixel (x, y) on. Each
/// square divides into four smaller ones, down to single pixels. A sample lies at the upper left
/// corner of one or more cells and belongs to the largest of them.
struct Cells {
  int width = 100;  ///< image width in pixels
  int max_cell = 16;
  int x = 0, y = 0;  ///< upper left pixel of the first cell
  CellOrder order = CellOrder::random;
  /// If set, replaces squares by quadrants: each sample's cell is a quadrant of size 1, and its
  /// place is the quadrant's rank.
  std::shared_ptr<const renderer::progressive::QuadrantOrder> quadrants = nullptr;

  int size_of(std::uint32_t sample) const;
  /// Position of a sample among cells of equal size; 0 if the order is random.
  std::uint64_t place_of(std::uint32_t sample) const;
  /// Fineness of the sample's cell: lower than that of any larger cell that overlaps it.
  std::uint32_t fineness_of(std::uint32_t sample) const;
  /// The part of the sample's cell within `limit`.
  renderer::Area area_of(std::uint32_t sample, const renderer::Area& limit) const;
  /// Divides the cell of `sample` down to single pixels. Returns the new samples within `limit`.
  /// Each sample of size less than max_cell results from the division of exactly one cell.
  std::vector<std::uint32_t> divide(std::uint32_t sample, const renderer::Area& limit) const;
  /// Position of a sample in the queue of quadrants.
  std::uint32_t rank_of(std::uint32_t sample) const;
};

/// Makes the primary rays in the order in which they are stored: from the largest cells to the
/// smallest, and within a size as `cells` specifies. With CellOrder::adaptive, only for the largest
/// cells.
std::vector<renderer::Ray> make_initial_rays(const renderer::Scene& scene,
                                             const renderer::Params& params, const Cells& cells,
                                             std::uint64_t seed);

/// The way in which a sample paints its cell (thesis, 4.3.7).
enum class CellLight : std::uint8_t {
  constant,  ///< paints the whole cell in the sample's colour
  point,     ///< paints only the sample's pixel
  smooth     ///< interpolates bilinearly between the known samples at the cell's corners
};

/// Final sums of a complete adaptive pixel whose samples have unequal weights.
struct FinishedPixel {
  std::uint32_t sample = 0;      ///< y * width + x
  renderer::Samples::Sums sums;  ///< eval_estimate() multiplied by the pixel's number of samples
};

/// The growing picture on the display. Each pixel shows the smallest sampled cell that contains it,
/// or else the background (black by default). When all samples have arrived, the picture equals the
/// image.
class FrameBuffer {
 public:
  FrameBuffer() = default;
  /// Paints only within `area`; 0 x 0 stands for the whole image.
  FrameBuffer(int width, int height, Cells cells, CellLight light, renderer::Area area = {},
              const renderer::Sampling& sampling = {});

  /// Adds a ray's contribution to its sample and repaints. A pixel shows the mean of those of its
  /// samples whose primary ray has arrived. Returns true if the picture has changed.
  bool add(const renderer::Ray& ray, const renderer::Rgb& contribution, renderer::Work& work);
  /// Replaces the sums of a complete adaptive pixel and repaints.
  void finish(const FinishedPixel& finished, renderer::Work& work);
  /// Sets the background, a picture of the same size.
  void set_background(std::vector<std::uint8_t> rgb8) { rgb8_ = std::move(rgb8); }
  /// Adds a block of complete samples.
  void add(const renderer::Block& block, renderer::Work& work);

  /// The samples; equal to those of render() once all have arrived.
  renderer::Samples samples() const;
  /// The picture, rows from the top, 3 bytes per pixel, in the format of renderer::make_rgb8.
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
  std::vector<std::uint16_t> counts_;  // number of samples of each pixel, if above one
  std::vector<std::uint32_t> owner_;   // fineness of the cell shown at each pixel
  std::vector<std::uint8_t> rgb8_;
};

}  // namespace farm
