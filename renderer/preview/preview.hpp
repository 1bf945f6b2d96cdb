#pragma once
// Pictures that are there before the first ray: a scene by z-buffer, in steps each better and
// dearer than the one before (L. Bergman et al., Image Rendering by Adaptive Refinement, SIGGRAPH
// 1986; thesis, 4.1).

#include "renderer/image/image.hpp"
#include "renderer/trace/params.hpp"

namespace renderer {

enum class PreviewStep : std::uint8_t {
  points,   ///< corners of polygons, and of what spheres and cones are divided into
  edges,    ///< edges that nothing hides
  flat,     ///< facets of one colour, that of their middle
  gouraud,  ///< colours interpolated between those of the facets' corners
  phong,    ///< light on the object itself at every pixel, as if nothing hid the lights
  shadows   ///< the same with a shadow feeler to every light
};

/// By their names above.
const base::Names<PreviewStep>& preview_steps();

/// What a preview did beside its light, which Work counts, since the ray tracer's kernels make it.
/// `edges` draws facets twice: to hide, and their edges.
struct PreviewCounts {
  std::uint64_t vertices = 0;       ///< corners of facets, taken to the image
  std::uint64_t facets = 0;         ///< drawn; not those on the far side of a sphere
  std::uint64_t pixels_tested = 0;  ///< compared with the z-buffer
  std::uint64_t pixels_drawn = 0;   ///< written, nearer than what was there
  bool operator==(const PreviewCounts&) const = default;
};

struct Preview {
  Samples samples;  ///< of the whole image; 0 outside the area of interest
  /// The object that a pixel shows, by y * width + x, or NO_OBJECT.
  std::vector<std::uint32_t> objects;
  PreviewCounts counts;
  Work work;
};

/// The preview of `params.area`. Samples lie where render() has them, and light is as it has it,
/// but for reflected and transmitted light, which is left out. Polygons and patches are drawn as
/// they are; spheres and cones as facets so small that their outlines are wrong by half a pixel at
/// most. `phong` and `shadows` find the point of a pixel on the object that the z-buffer holds for
/// it: a pixel of `shadows` is that of render() with limits.depth 1 wherever both show the same
/// object. Points and edges have their surface's colour, less of it the farther away they are, on
/// the background. The limits have no effect. BadInput as check().
Preview make_preview(const Scene& scene, const Params& params, PreviewStep step);

}  // namespace renderer
