#pragma once
// Adaptive supersampling in the farm: collects the samples of each pixel, and requests further
// samples if they differ.
#include <unordered_map>
#include <unordered_set>

#include "renderer/trace/adaptive.hpp"
#include "simulator/farm/rays/cells.hpp"

namespace farm {

/// The samples of unfinished pixels, owned by the coordination process.
class Ledger {
 public:
  explicit Ledger(const renderer::Params& params);

  /// Returns the corners of a pixel without the corners already requested before, as arguments (x,
  /// y) of make_probe(). Marks them as requested.
  std::vector<std::pair<int, int>> ask_corners(std::uint32_t pixel);
  /// Records the object hit by a probe ray at a corner. Returns the pixels whose four corners are
  /// now all known.
  std::vector<std::uint32_t> note_corner(std::uint32_t corner, std::uint32_t object);
  /// Records the hit and the contribution of a ray, and how many child rays it has.
  void note(const renderer::Ray& ray, const std::optional<renderer::Hit>& hit,
            const renderer::Rgb& contribution, std::size_t children);
  /// Returns the number of the pixel's next sample, or none if the pixel needs none or must wait.
  /// Samples are taken in rounds. Within a round, a sample waits for the primary ray of the
  /// previous one. A new round waits for all rays of the previous round and for the pixel's
  /// corners.
  std::optional<int> next_sample(std::uint32_t pixel);
  /// Returns the pixels that next_sample() has finished since the previous call, as arguments of
  /// FrameBuffer::finish(). Omits pixels whose samples have equal weights.
  std::vector<FinishedPixel> take_finished() { return std::exchange(finished_, {}); }
  std::size_t samples_held() const { return held_; }

 private:
  struct Pixel : renderer::OpenPixel {
    using OpenPixel::OpenPixel;
    std::size_t under_way = 0;  // number of child rays of its samples that have not returned
    int begun = 1;              // number of samples whose primary ray was requested
  };
  void finish(std::uint32_t number, const Pixel& pixel, const renderer::Corners& corners);
  std::optional<renderer::Corners> find_corners(std::uint32_t pixel) const;

  const renderer::Params& params_;
  const renderer::Area area_;
  std::unordered_map<std::uint32_t, Pixel> open_;
  std::unordered_set<std::uint32_t> asked_;  // corners whose probe rays have been requested
  // Number of the object seen at each known corner.
  std::unordered_map<std::uint32_t, std::uint32_t> corners_;
  std::size_t held_ = 0;
  std::vector<FinishedPixel> finished_;
};

}  // namespace farm
