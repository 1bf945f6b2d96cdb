#pragma once
// Adaptive supersampling in the farm: collects each pixel's samples, and adds more if they differ.
#include <unordered_map>
#include <unordered_set>

#include "renderer/trace/adaptive.hpp"
#include "simulator/farm/rays/cells.hpp"

namespace farm {

/// Owned by the coordination. Drops samples of finished pixels.
class Ledger {
 public:
  explicit Ledger(const renderer::Params& params);

  /// Corners of a pixel not requested before, as (x, y) of make_probe(). Marks them as requested.
  std::vector<std::pair<int, int>> ask_corners(std::uint32_t pixel);
  /// Notes the object that a probe hit. Returns the pixels whose last unknown corner this was.
  std::vector<std::uint32_t> note_corner(std::uint32_t corner, std::uint32_t object);
  /// Notes the hit and contribution of a sample's ray, and the number of its child rays.
  void note(const renderer::Ray& ray, const std::optional<renderer::Hit>& hit,
            const renderer::Rgb& contribution, std::size_t children);
  /// The pixel's next sample, if wanted and ready. Within a round, it waits for the primary ray of
  /// the sample before. A new round waits for all rays of the last one and for the corners.
  std::optional<int> next_sample(std::uint32_t pixel);
  /// Pixels finished by next_sample() since the last call, for FrameBuffer::finish(). Omits pixels
  /// whose samples have equal weights.
  std::vector<FinishedPixel> take_finished() { return std::exchange(finished_, {}); }
  std::size_t samples_held() const { return held_; }

 private:
  struct Pixel : renderer::OpenPixel {
    using OpenPixel::OpenPixel;
    std::size_t under_way = 0;  // rays of its samples that are outstanding
    int begun = 1;              // samples
  };
  void finish(std::uint32_t number, const Pixel& pixel, const renderer::Corners& corners);
  std::optional<renderer::Corners> find_corners(std::uint32_t pixel) const;

  const renderer::Params& params_;
  const renderer::Area area_;
  std::unordered_map<std::uint32_t, Pixel> open_;
  std::unordered_set<std::uint32_t> asked_;                   // corners requested
  std::unordered_map<std::uint32_t, std::uint32_t> corners_;  // known object at each corner
  std::size_t held_ = 0;
  std::vector<FinishedPixel> finished_;
};

}  // namespace farm
