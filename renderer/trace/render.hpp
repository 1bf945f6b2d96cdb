#pragma once
// The sequential renderer. Images of the parallel renderers must equal its image bit for bit.

#include <functional>

#include "renderer/trace/adaptive.hpp"

namespace renderer {

/// Number of rays traced, by kind.
struct RayCounts {
  std::uint64_t probes = 0;  ///< rays through corners of pixels (see make_probe())
  std::uint64_t primary = 0;
  std::uint64_t primary_hit = 0;  ///< number of primary rays that hit an object
  std::uint64_t reflected = 0, transmitted = 0, shadow = 0;

  std::uint64_t total() const { return probes + primary + reflected + transmitted + shadow; }
  void add(RayKind kind, bool hit);
  RayCounts& operator+=(const RayCounts& other);
  bool operator==(const RayCounts&) const = default;
};

struct Rendering {
  Samples samples;  ///< samples of the whole image; 0 outside the area of interest
  /// Number of samples of each pixel with adaptive sampling; otherwise empty.
  std::vector<std::uint16_t> counts;
  RayCounts rays;
  Work work;
};

/// Traces samples one by one, in any order.
class SampleTracer {
 public:
  SampleTracer(const Scene& scene, const Params& params, Access* access = nullptr)
      : scene_(scene), params_(params), access_(access) {}

  /// Traces the shading tree of sample `pass` of pixel (x, y), depth first.
  TracedSample trace(int x, int y, int pass);
  /// The number of the object seen at the upper left corner of pixel (x, y), or NO_OBJECT.
  std::uint32_t probe(int x, int y);

  RayCounts rays;
  Work work;
  Children stack;  ///< memory for rays; empty between samples

 private:
  const Scene& scene_;
  const Params& params_;
  Access* access_;
};

/// A rectangle of the image that is rendered separately.
struct Block {
  Area area;
  Samples samples;                    ///< samples of `area` only
  std::vector<std::uint16_t> counts;  ///< numbers of samples, as Rendering::counts, for `area` only
  RayCounts rays;
  Work work;
};

/// Renders `area`, which must lie inside the image of `params`. The sums equal those of render().
/// Calls `access`, unless null, before each part of the scene is read.
Block render_block(const Scene& scene, const Params& params, const Area& area,
                   Access* access = nullptr);

/// A block whose memory is reused when several blocks are rendered one after the other.
struct BlockBuffer {
  Block block;
  Children pending;  ///< memory for rays
};
/// Renders an area into the buffer and overwrites its previous block.
void render_block(const Scene& scene, const Params& params, const Area& area, BlockBuffer& buffer,
                  Access* access = nullptr);

/// Adds the sums of `block` to the image. Counts one Op::sample_updated for each sum.
void add_block(Samples& image, const Block& block, Work& work);

/// A function that is called after every row of pixels, by one thread at a time. It ends the
/// rendering by returning false.
using Progress = std::function<bool(int done, int rows)>;

/// A function that ends the rendering by returning true. It is called before every pixel, by any
/// thread, possibly by several at once.
using IsStopped = std::function<bool()>;

/// Throws BadInput unless there are 1 to 1024 host threads.
void check_threads(int threads);

/// Renders `params.area`. If `progress` ends the rendering, the remaining rows have no samples; if
/// `is_stopped` does, any pixels may lack samples. The image, the counts and the work of a complete
/// rendering do not depend on `threads`. Throws BadInput as check() and check_threads() do.
/// Exceptions of `progress` end the rendering.
Rendering render(const Scene& scene, const Params& params, int threads = 1,
                 const Progress& progress = {}, const IsStopped& is_stopped = {});

}  // namespace renderer
