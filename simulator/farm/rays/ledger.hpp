#pragma once
// Adaptive supersampling in the farm: collects each pixel's samples and requests more if they
// differ.
#include <unordered_map>
#include <unordered_set>

#include "renderer/trace/adaptive.hpp"
#include "simulator/farm/rays/cells.hpp"

namespace farm {

/// The samples of unfinished pixels, owned by the coordination process.
class Ledger {
 public:
  explicit Ledger(const renderer::Params& params);

  /// Returns the corners of a pixel that have not been requested before, as (x, y) of make_probe(),
  /// and marks them as requested.
  std::vector<std::pair<int, int>> ask_corners(std::uint32_t pixel);
  /// Records the object hit by a probe. Returns the pixels for which this was the last unknown
  /// corner.
  std::vector<std::uint32_t> note_corner(std::uint32_t corner, std::uint32_t object);
  /// Records the hit and contribution of a sample's ray, and the number of its children.
  void note(const renderer::Ray& ray, const std::optional<renderer::Hit>& hit,
            const renderer::Rgb& contribution, std::size_t children);
  /// The number of the pixel's next sample; none if it needs none or must wait. Within a round, a
  /// sample waits for the primary ray of the previous one. A new round waits for all rays of the
  /// previous round and for the corners.
  std::optional<int> next_sample(std::uint32_t pixel);
  /// Returns the pixels finished by next_sample() since the previous call, for
  /// FrameBuffer::finish(). Does not include pixels whose samples have equal weights.
  std::vector<FinishedPixel> take_finished() { return std::exchange(finished_, {}); }
  std::size_t samples_held() const { return held_; }

 private:
  struct Pixel : renderer::OpenPixel {
    using OpenPixel::OpenPixel;
    std::size_t under_way = 0;  // number of outstanding rays of its samples
    int begun = 1;              // number of samples begun
  };
  void finish(std::uint32_t number, const Pixel& pixel, const renderer::Corners& corners);
  std::optional<renderer::Corners> find_corners(std::uint32_t pixel) const;

  const renderer::Params& params_;
  const renderer::Area area_;
  std::unordered_map<std::uint32_t, Pixel> open_;
  std::unordered_set<std::uint32_t> asked_;                   // requested corners
  std::unordered_map<std::uint32_t, std::uint32_t> corners_;  // known object at each corner
  std::size_t held_ = 0;
  std::vector<FinishedPixel> finished_;
};

}  // namespace farm
