#pragma once
// Image cells (thesis, 4.3.2 and 4.3.7): squares of which one sample, at the upper left corner, is
// computed first; what a sample shows of its cell, and the order in which cells come.
#include <memory>
#include <optional>
#include <vector>

#include "renderer/progressive/quadrants.hpp"
#include "renderer/trace/render.hpp"
#include "renderer/trace/shade.hpp"

namespace farm {

/// The order of cells of one size (thesis, 4.3.7).
enum class CellOrder : std::uint8_t {
  random,      ///< drawn from a seed
  sequential,  ///< from the top to the bottom, from the left to the right
  recursive,   ///< as quadrants of quadrants: upper left, upper right, lower left, lower right
  adaptive     ///< random; but a cell is made when the one it divides has been sampled, and goes
               ///< before cells up to four times as large if that shows another object than its
               ///< neighbours
};

/// Squares of `max_cell` pixels (a power of two) tile the image from the pixel (x, y), and each is
/// divided into four smaller ones, down to single pixels. A sample lies at the upper left corners
/// of one or several cells, and belongs to the largest of them.
struct Cells {
  int width = 100;  ///< width of the image, pixels
  int max_cell = 16;
  int x = 0, y = 0;  ///< pixels: where the first cell is
  CellOrder order = CellOrder::random;
  /// In place of squares: every sample's cell is a quadrant, with its rank as its place, and counts
  /// as one pixel large.
  std::shared_ptr<const renderer::progressive::QuadrantOrder> quadrants = nullptr;

  int size_of(std::uint32_t sample) const;
  /// The place of a sample among cells of one size; 0 where the order has none.
  std::uint64_t place_of(std::uint32_t sample) const;
  /// Of two samples' cells that overlap the one of lower number is the smaller one.
  std::uint32_t fineness_of(std::uint32_t sample) const;
  /// The part of the sample's cell that lies within `limit`.
  renderer::Area area_of(std::uint32_t sample, const renderer::Area& limit) const;
  /// The samples of the cells into which the cell of `sample` is divided, down to single pixels,
  /// as far as those lie within `limit`: each sample that is not of max_cell belongs to one.
  std::vector<std::uint32_t> divide(std::uint32_t sample, const renderer::Area& limit) const;
  /// The place of a sample in the queue of quadrants.
  std::uint32_t rank_of(std::uint32_t sample) const;
};

/// The primary rays in the order of their deposit: cells from the largest to the smallest, those of
/// one size in their order; with CellOrder::adaptive only the largest.
std::vector<renderer::Ray> make_initial_rays(const renderer::Scene& scene,
                                             const renderer::Params& params, const Cells& cells,
                                             std::uint64_t seed);

/// What a sample shows of its cell (thesis, 4.3.7).
enum class CellLight : std::uint8_t {
  constant,  ///< all of it has its colour
  point,     ///< only the sample's pixel is lit
  smooth     ///< bilinear between the samples at its corners, where there are any
};

/// An adaptive pixel that has all of its samples, whose weights in its colour differ.
struct FinishedPixel {
  std::uint32_t sample = 0;      ///< y * width + x
  renderer::Samples::Sums sums;  ///< eval_estimate() times the number of the pixel's samples
};

/// The display's picture, painted while samples grow. A pixel shows the smallest cell around it
/// that has a sample; one that has none shows the background, which is black. When all samples are
/// there it is the image.
class FrameBuffer {
 public:
  FrameBuffer() = default;
  /// Cells are painted within `area` alone; 0 x 0: everywhere.
  FrameBuffer(int width, int height, Cells cells, CellLight light, renderer::Area area = {},
              const renderer::Sampling& sampling = {});

  /// Adds a ray's contribution to its sample, and paints what that changes: a pixel shows the mean
  /// of those of its samples whose primary ray has come. Returns whether a pixel of the picture has
  /// another colour now.
  bool add(const renderer::Ray& ray, const renderer::Rgb& contribution, renderer::Work& work);
  /// Replaces the sums of an adaptive pixel that has all of its samples, and paints the change.
  void finish(const FinishedPixel& finished, renderer::Work& work);
  /// What pixels show that have no cell with a sample: a picture of as many pixels.
  void set_background(std::vector<std::uint8_t> rgb8) { rgb8_ = std::move(rgb8); }
  /// Adds a block of complete samples.
  void add(const renderer::Block& block, renderer::Work& work);

  /// As render() has them, when all have come.
  renderer::Samples samples() const;
  /// Rows from the top, 3 bytes a pixel, as renderer::make_rgb8 has them.
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
  std::vector<std::uint16_t> counts_;  // of a pixel's samples, if there are more than one
  std::vector<std::uint32_t> owner_;   // fineness of the cell that each pixel shows
  std::vector<std::uint8_t> rgb8_;
};

}  // namespace farm
