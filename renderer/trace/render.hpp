#pragma once
// The sequential renderer: what every parallel one must equal, bit for bit.

#include <functional>

#include "renderer/trace/adaptive.hpp"

namespace renderer {

/// Rays intersected, by kind.
struct RayCounts {
  std::uint64_t probes = 0;  ///< of pixels' corners, see make_probe()
  std::uint64_t primary = 0;
  std::uint64_t primary_hit = 0;  ///< primary rays that hit something
  std::uint64_t reflected = 0, transmitted = 0, shadow = 0;

  std::uint64_t total() const { return probes + primary + reflected + transmitted + shadow; }
  void add(RayKind kind, bool hit);
  RayCounts& operator+=(const RayCounts& other);
  bool operator==(const RayCounts&) const = default;
};

struct Rendering {
  Samples samples;  ///< of the whole image; 0 outside the area of interest
  /// With adaptive sampling, how many samples each pixel has had; else empty.
  std::vector<std::uint16_t> counts;
  RayCounts rays;
  Work work;
};

/// Traces one sample after the other, in any order.
class SampleTracer {
 public:
  SampleTracer(const Scene& scene, const Params& params, Access* access = nullptr)
      : scene_(scene), params_(params), access_(access) {}

  /// A sample's whole shading tree, depth first.
  TracedSample trace(int x, int y, int pass);
  /// The object at the upper left corner of a pixel.
  std::uint32_t probe(int x, int y);

  RayCounts rays;
  Work work;
  Children stack;  ///< memory for rays; empty between samples

 private:
  const Scene& scene_;
  const Params& params_;
  Access* access_;
};

/// A rectangle of the image, rendered alone.
struct Block {
  Area area;
  Samples samples;                    ///< of the area's pixels only
  std::vector<std::uint16_t> counts;  ///< as Rendering's, of the area's pixels only
  RayCounts rays;
  Work work;
};

/// Traces every ray of `area`, which lies within the image of `params`. The sums are those that
/// render() finds there. `access`, unless null, is told of every part of the scene that is read.
Block render_block(const Scene& scene, const Params& params, const Area& area,
                   Access* access = nullptr);

/// A block, and the memory that rendering needs, for one block after the other.
struct BlockBuffer {
  Block block;
  Children pending;  ///< memory for rays
};
/// The same into a buffer, whose block before is overwritten.
void render_block(const Scene& scene, const Params& params, const Area& area, BlockBuffer& buffer,
                  Access* access = nullptr);

/// Adds the sums of `block` to those of the image, and counts one Op::sample_updated a sum.
void add_block(Samples& image, const Block& block, Work& work);

/// Is called after every row, by one thread at a time; false ends the rendering.
using Progress = std::function<bool(int done, int rows)>;

/// BadInput unless there are 1 to 1024 host threads.
void check_threads(int threads);

/// Traces every ray of `params.area`, or of the rows before `progress` ended it: the others have no
/// sample. Result, counts and work of a whole image do not depend on `threads`.
/// BadInput as check() and check_threads(); what `progress` throws ends the rendering.
Rendering render(const Scene& scene, const Params& params, int threads = 1,
                 const Progress& progress = {});

}  // namespace renderer
