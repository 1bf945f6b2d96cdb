#pragma once
// Adaptive supersampling in the farm: what has come of each pixel's samples, of which there are
// more where those that have come call for them.
#include <unordered_map>
#include <unordered_set>

#include "renderer/trace/adaptive.hpp"
#include "simulator/farm/rays/cells.hpp"

namespace farm {

/// Kept by the coordination. Samples of finished pixels are forgotten.
class Ledger {
 public:
  explicit Ledger(const renderer::Params& params);

  /// The corners of a pixel that nobody has asked for, as (x, y) of make_probe(): from now on they
  /// are asked for.
  std::vector<std::pair<int, int>> ask_corners(std::uint32_t pixel);
  /// What a probe has met. Returns the pixels of which that was the last that had to be known.
  std::vector<std::uint32_t> note_corner(std::uint32_t corner, std::uint32_t object);
  /// What a ray of a sample has met and contributes, and how many rays it leaves.
  void note(const renderer::Ray& ray, const std::optional<renderer::Hit>& hit,
            const renderer::Rgb& contribution, std::size_t children);
  /// The pixel's next sample, if one is wanted and can begin: within a round when the primary ray
  /// of the sample before it has come, a round when all of the round before it and the corners
  /// have.
  std::optional<int> next_sample(std::uint32_t pixel);
  /// Pixels finished by next_sample() since the last call, for FrameBuffer::finish(). Pixels whose
  /// samples have equal weights are left out.
  std::vector<FinishedPixel> take_finished() { return std::exchange(finished_, {}); }
  std::size_t samples_held() const { return held_; }

 private:
  struct Pixel : renderer::OpenPixel {
    using OpenPixel::OpenPixel;
    std::size_t under_way = 0;  // rays that its samples have left
    int begun = 1;              // samples
  };
  void finish(std::uint32_t number, const Pixel& pixel, const renderer::Corners& corners);
  std::optional<renderer::Corners> find_corners(std::uint32_t pixel) const;

  const renderer::Params& params_;
  const renderer::Area area_;
  std::unordered_map<std::uint32_t, Pixel> open_;
  std::unordered_set<std::uint32_t> asked_;                   // corners
  std::unordered_map<std::uint32_t, std::uint32_t> corners_;  // objects that are known
  std::size_t held_ = 0;
  std::vector<FinishedPixel> finished_;
};

}  // namespace farm
