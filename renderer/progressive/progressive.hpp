#pragma once
// The sequential ray tracer with increasing realism (thesis, 4.2). Users improve an image step by
// step: they ask for deeper shading trees, and for smaller cells in areas of interest.

#include <functional>
#include <optional>

#include "renderer/progressive/cells.hpp"
#include "renderer/progressive/params.hpp"
#include "renderer/progressive/tree_levels.hpp"

namespace renderer::progressive {

/// Counts of one step.
struct StepCounts {
  std::uint64_t samples = 0;      ///< number of new samples
  std::uint64_t deepened = 0;     ///< samples whose shading tree got more levels
  std::uint64_t by_contrast = 0;  ///< cells divided because of their contrast
  /// Cells divided because they might hide an object, by the pyramid test.
  std::uint64_t by_pyramid = 0;
  std::uint64_t boxes = 0;  ///< bounding boxes examined by the pyramid test
  std::uint64_t cells = 0;  ///< number of cells after the step
  TreeRays rays;
};

/// Percentage of rays that were traced again, 100 N_A / N_T (thesis Eq 4.1 to 4.6); 0 for a step
/// without new rays.
double get_repeated_percent(const TreeRays& rays);

/// A function that stops a step by returning true. Every thread calls it before each of its
/// samples.
using Stop = std::function<bool()>;

class Progressive {
 public:
  /// `scene` must outlive the object. `max_cell` is the side of the first cells in pixels.
  /// `threads` is the number of host threads, at least 1. `params.limits.depth` and `params.area`
  /// have no effect, because each step states its own. Throws BadInput as check() does.
  Progressive(const Scene& scene, const Params& params, int max_cell, int threads = 1);

  /// Executes a step. The first step divides the whole image into cells with sides of `max_cell`
  /// pixels, and samples their corners. Every step deepens the shading trees of the samples in
  /// `step.area` to `step.depth` levels. Then it divides cells in this area repeatedly. A cell
  /// larger than `step.min_cell` is divided if its contrast exceeds `step.contrast`, or if it may
  /// show an object that no sample has hit.
  ///
  /// After a step over the whole image with `min_cell` 1 and the pyramid test, every object that is
  /// visible at a pixel has been hit by a sample. The result depends on earlier steps, but not on
  /// the number of threads. Returns none if `is_stopped` ended the step; the picture is then
  /// invalid. Throws BadInput as check() does.
  std::optional<StepCounts> advance(const Step& step, const Stop& is_stopped);
  StepCounts advance(const Step& step) {
    return *advance(step, [] { return false; });
  }

  /// The picture to be displayed. Unsampled pixels are interpolated.
  Samples make_picture() const;
  const Sampled& sampled() const { return sampled_; }
  /// True if a ray from the eye has hit the object with this number.
  bool is_observed(std::uint32_t object) const { return seen_[object]; }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  struct Wanted {
    int x, y;
    int from;  // number of levels that the shading tree already has
  };
  enum class Verdict { keep, contrast, pyramid };

  void want(int x, int y, int depth);
  void want_corners(const Cell& cell, int depth);
  void deepen_border(const Cell& cell, int depth);
  bool trace_wanted(int depth, const Stop& is_stopped, StepCounts& counts);
  bool divide_cells(const Step& step, StepCounts& counts);
  Verdict judge(const Cell& cell, const Step& step, StepCounts& counts) const;

  const Scene& scene_;
  Params params_;
  int max_cell_, threads_;
  Sampled sampled_;
  std::vector<bool> seen_;  // by object: true if a ray from the eye has hit it
  std::vector<Cell> cells_;
  std::vector<Wanted> wanted_;
};

}  // namespace renderer::progressive
