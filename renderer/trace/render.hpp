#pragma once
// The sequential renderer. Parallel renderers must match it bit for bit.

#include <functional>

#include "renderer/trace/adaptive.hpp"

namespace renderer {

/// Number of rays intersected, by kind.
struct RayCounts {
  std::uint64_t probes = 0;  ///< rays through corners of pixels (see make_probe())
  std::uint64_t primary = 0;
  std::uint64_t primary_hit = 0;  ///< primary rays that hit an object
  std::uint64_t reflected = 0, transmitted = 0, shadow = 0;

  std::uint64_t total() const { return probes + primary + reflected + transmitted + shadow; }
  void add(RayKind kind, bool hit);
  RayCounts& operator+=(const RayCounts& other);
  bool operator==(const RayCounts&) const = default;
};

struct Rendering {
  Samples samples;  ///< samples of the whole image; 0 outside the area of interest
  /// The number of samples at each pixel with adaptive sampling; else empty.
  std::vector<std::uint16_t> counts;
  RayCounts rays;
  Work work;
};

/// Tracer of samples, one by one in any order.
class SampleTracer {
 public:
  SampleTracer(const Scene& scene, const Params& params, Access* access = nullptr)
      : scene_(scene), params_(params), access_(access) {}

  /// Traces the shading tree of a sample, depth first.
  TracedSample trace(int x, int y, int pass);
  /// The object at the upper left corner of a pixel.
  std::uint32_t probe(int x, int y);

  RayCounts rays;
  Work work;
  Children stack;  ///< buffer for rays; empty between samples

 private:
  const Scene& scene_;
  const Params& params_;
  Access* access_;
};

/// A rectangle of the image, rendered alone.
struct Block {
  Area area;
  Samples samples;                    ///< samples of the area only
  std::vector<std::uint16_t> counts;  ///< numbers of samples as in Rendering, for the area only
  RayCounts rays;
  Work work;
};

/// Traces every ray of `area`, which lies inside the image of `params`. The sums equal those of
/// render(). Calls `access`, unless null, for every part of the scene that is read.
Block render_block(const Scene& scene, const Params& params, const Area& area,
                   Access* access = nullptr);

/// A block with reusable memory, for rendering several blocks in turn.
struct BlockBuffer {
  Block block;
  Children pending;  ///< buffer for rays
};
/// Renders a block into a buffer, and overwrites its previous block.
void render_block(const Scene& scene, const Params& params, const Area& area, BlockBuffer& buffer,
                  Access* access = nullptr);

/// Adds the sums of `block` to those of the image. Counts one Op::sample_updated for each sum.
void add_block(Samples& image, const Block& block, Work& work);

/// Callback after every row, called by one thread at a time. Returning false ends the rendering.
using Progress = std::function<bool(int done, int rows)>;

/// Throws BadInput unless there are 1 to 1024 host threads.
void check_threads(int threads);

/// Traces every ray of `params.area`. If `progress` ends it, the remaining rows have no samples.
/// Result, counts and work of a complete image do not depend on `threads`. Throws BadInput as
/// check() and check_threads() do. Exceptions of `progress` end the rendering.
Rendering render(const Scene& scene, const Params& params, int threads = 1,
                 const Progress& progress = {});

}  // namespace renderer
