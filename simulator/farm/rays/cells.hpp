#pragma once
// Image cells (thesis, 4.3.2 and 4.3.7): square tiles of the image. A cell's upper left pixel is
// its sample. Defines the order of sampling the cells, and how a sample paints its cell.
#include <memory>
#include <optional>
#include <vector>

#include "renderer/progressive/quadrants.hpp"
#include "renderer/trace/render.hpp"
#include "renderer/trace/shade.hpp"

namespace farm {

/// The order of sampling for cells of equal size (thesis, 4.3.7).
enum class CellOrder : std::uint8_t {
  random,      ///< random, determined by a seed
  sequential,  ///< from top to bottom, each row from left to right
  recursive,   ///< recursively by quadrants: upper left, upper right, lower left, lower right
  /// Random order. A cell is made only after the larger cell that contains it has been sampled. If
  /// the larger cell's sample shows another object than the sample of a neighbouring cell, the new
  /// cell precedes cells up to four times as large.
  adaptive
};

/// Tiling of the image by squares with a side of `max_cell` pixels (a power of two), starting at
/// pixel (x, y). Each square divides into four smaller ones, down to single pixels. A sample is a
/// pixel, identified by its number y * width + x. A pixel can be the upper left corner of several
/// cells; its sample belongs to the largest of them.
struct Cells {
  int width = 100;  ///< image width in pixels
  int max_cell = 16;
  int x = 0, y = 0;  ///< upper left pixel of the first cell
  CellOrder order = CellOrder::random;
  /// If set, quadrants of the image replace the squares. A sample's cell is then a quadrant,
  /// size_of() returns 1, and place_of() returns the quadrant's rank.
  std::shared_ptr<const renderer::progressive::QuadrantOrder> quadrants = nullptr;

  int size_of(std::uint32_t sample) const;
  /// Position of a sample among the samples of cells of equal size; 0 if the order is random.
  std::uint64_t place_of(std::uint32_t sample) const;
  /// Rank of the sample's cell by size, 0 for the smallest. A cell has a lower rank than every
  /// larger cell that overlaps it.
  std::uint32_t fineness_of(std::uint32_t sample) const;
  /// The pixels of the sample's cell that lie within `limit`.
  renderer::Area area_of(std::uint32_t sample, const renderer::Area& limit) const;
  /// Divides the cell of `sample` down to single pixels. Returns the new samples within `limit`.
  /// Every sample whose cell is smaller than max_cell is returned for exactly one cell.
  std::vector<std::uint32_t> divide(std::uint32_t sample, const renderer::Area& limit) const;
  /// Position of a sample in the order of quadrants, from 0. Requires `quadrants`.
  std::uint32_t rank_of(std::uint32_t sample) const;
};

/// Makes the first primary ray of each sample, in the order of storing. Larger cells precede
/// smaller ones, and `cells` specifies the order of cells of equal size. With CellOrder::adaptive,
/// makes only the rays of the largest cells.
std::vector<renderer::Ray> make_initial_rays(const renderer::Scene& scene,
                                             const renderer::Params& params, const Cells& cells,
                                             std::uint64_t seed);

/// How a sample paints its cell (thesis, 4.3.7).
enum class CellLight : std::uint8_t {
  constant,  ///< paints the whole cell in the sample's colour
  point,     ///< paints only the sample's pixel
  smooth     ///< interpolates bilinearly between the known samples at the cell's corners
};

/// Final sums of a complete pixel to whose samples adaptive sampling has given unequal weights.
struct FinishedPixel {
  std::uint32_t sample = 0;  ///< number of the pixel: y * width + x
  /// The pixel's estimated colour multiplied by its number of samples.
  renderer::Samples::Sums sums;
};

/// The picture on the display during the run. Each pixel shows the smallest sampled cell that
/// contains it, or else the background (black by default). When all samples have arrived, the
/// picture equals the image.
class FrameBuffer {
 public:
  FrameBuffer() = default;
  /// Paints only pixels within `area`; an area of 0 x 0 stands for the whole image.
  FrameBuffer(int width, int height, Cells cells, CellLight light, renderer::Area area = {},
              const renderer::Sampling& sampling = {});

  /// Adds a ray's contribution to its pixel and repaints. A pixel shows the mean of its samples
  /// whose primary rays have arrived. Returns true if the picture has changed.
  bool add(const renderer::Ray& ray, const renderer::Rgb& contribution, renderer::Work& work);
  /// Replaces the sums of a complete pixel by its final sums, and repaints the pixel. Used with
  /// adaptive sampling.
  void finish(const FinishedPixel& finished, renderer::Work& work);
  /// Sets the background, a picture with the size of the image.
  void set_background(std::vector<std::uint8_t> rgb8) { rgb8_ = std::move(rgb8); }
  /// Adds a block of complete pixels.
  void add(const renderer::Block& block, renderer::Work& work);

  /// The sums of all pixels. When all rays have arrived, they equal those of renderer::render().
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
  std::vector<std::uint16_t> counts_;  // samples of each pixel; empty if no pixel has several
  std::vector<std::uint32_t> owner_;   // for each pixel, fineness_of() the cell that it shows
  std::vector<std::uint8_t> rgb8_;
};

}  // namespace farm
