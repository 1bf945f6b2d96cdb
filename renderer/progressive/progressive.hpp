#pragma once
// The sequential ray tracer with increasing realism (thesis, 4.2). Users improve an image step by
// step, with deeper shading trees and smaller cells in areas of interest.

#include <functional>
#include <optional>

#include "renderer/progressive/cells.hpp"
#include "renderer/progressive/params.hpp"
#include "renderer/progressive/tree_levels.hpp"

namespace renderer::progressive {

/// Counts of one step.
struct StepCounts {
  std::uint64_t samples = 0;      ///< number of new samples
  std::uint64_t deepened = 0;     ///< samples with a deepened tree
  std::uint64_t by_contrast = 0;  ///< cells divided because of their contrast
  std::uint64_t by_pyramid = 0;   ///< cells divided because they might hide an object
  std::uint64_t boxes = 0;        ///< bounds examined by the pyramid test
  std::uint64_t cells = 0;        ///< number of cells after the step
  TreeRays rays;
};

/// Share of repeated rays in %, 100 N_A / N_T (Eq 4.1 to 4.6); 0 for a step without new rays.
double get_repeated_percent(const TreeRays& rays);

/// Callback that stops a step by returning true. Every thread calls it before each of its samples.
using Stop = std::function<bool()>;

class Progressive {
 public:
  /// `scene` must outlive the object. `threads` is the number of host threads, at least 1.
  /// `params.limits.depth` and `params.area` have no effect, since each step has its own. Throws
  /// BadInput as check() does.
  Progressive(const Scene& scene, const Params& params, int max_cell, int threads = 1);

  /// Executes a step. The first step makes cells with sides of `max_cell` over the whole image, and
  /// samples their corners. Every step selects the cells in `step.area`, deepens the trees of their
  /// samples to `step.depth`, and divides these cells until none qualifies. A cell larger than
  /// `min_cell` qualifies if it exceeds the contrast, or may hold an object that no sample has hit.
  ///
  /// After a step over the whole image with `min_cell` 1 and the pyramid test, a sample has hit
  /// every object that is visible at any pixel. The result depends on earlier steps, but not on the
  /// number of threads. Returns none if `is_stopped` ended the step; the picture is then invalid.
  /// Throws BadInput as check() does.
  std::optional<StepCounts> advance(const Step& step, const Stop& is_stopped);
  StepCounts advance(const Step& step) {
    return *advance(step, [] { return false; });
  }

  /// The displayed picture, with unsampled pixels interpolated.
  Samples make_picture() const;
  const Sampled& sampled() const { return sampled_; }
  /// True if a primary ray has hit the object.
  bool is_observed(std::uint32_t object) const { return seen_[object]; }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  struct Wanted {
    int x, y;
    int from;  // levels that the shading tree already has
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
  std::vector<bool> seen_;  // for each object, whether a primary ray has hit it
  std::vector<Cell> cells_;
  std::vector<Wanted> wanted_;
};

}  // namespace renderer::progressive
