#pragma once
// The sequential ray tracer with increasing realism (thesis, 4.2): an image that its user makes
// better step by step, by deeper shading trees and by smaller cells, where it is of interest.

#include <functional>
#include <optional>

#include "renderer/progressive/cells.hpp"
#include "renderer/progressive/params.hpp"
#include "renderer/progressive/tree_levels.hpp"

namespace renderer::progressive {

/// What one step did.
struct StepCounts {
  std::uint64_t samples = 0;      ///< new ones
  std::uint64_t deepened = 0;     ///< samples whose trees were made deeper
  std::uint64_t by_contrast = 0;  ///< cells divided because of their contrast
  std::uint64_t by_pyramid = 0;   ///< cells divided because they might hide an object
  std::uint64_t boxes = 0;        ///< bounds that the pyramid test looked at
  std::uint64_t cells = 0;        ///< of the image after the step
  TreeRays rays;
};

/// 100 N_A / N_T, the penalty of Eq 4.1 to 4.6; 0 for a step without a new ray.
double get_repeated_percent(const TreeRays& rays);

/// Is asked before every sample, by any thread.
using Stop = std::function<bool()>;

class Progressive {
 public:
  /// `scene` must outlive it; `threads` are host threads, at least 1. `params.limits.depth` and
  /// `params.area` have no effect: a step has its own. BadInput as check().
  Progressive(const Scene& scene, const Params& params, int max_cell, int threads = 1);

  /// The first step takes a sample at every corner of cells of max_cell steps a side, whatever its
  /// area. Every step makes the trees of the samples of the cells in its area as deep as it says,
  /// unless they are already, and divides those cells until none is left that it would divide: of
  /// those larger than min_cell, one above the contrast, or one that may hold an object that no
  /// sample has hit. (So after a step over the whole image with min_cell 1 and the pyramid test,
  /// every object that owns a pixel of the full image has a sample.) What a step does depends on
  /// the steps before, but not on the number of threads. Returns none where `is_stopped` has ended
  /// the step: then there is no picture any more. BadInput as check().
  std::optional<StepCounts> advance(const Step& step, const Stop& is_stopped);
  StepCounts advance(const Step& step) {
    return *advance(step, [] { return false; });
  }

  /// What is displayed: samples as they are, other pixels interpolated.
  Samples make_picture() const;
  const Sampled& sampled() const { return sampled_; }
  /// Whether a primary ray has hit an object.
  bool is_seen(std::uint32_t object) const { return seen_[object]; }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  struct Wanted {
    int x, y;
    int from;  // levels that the tree has
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
  std::vector<bool> seen_;  // objects
  std::vector<Cell> cells_;
  std::vector<Wanted> wanted_;
};

}  // namespace renderer::progressive
