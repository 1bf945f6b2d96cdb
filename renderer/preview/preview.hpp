#pragma once
// Preview pictures of a scene by z-buffer, available before the first ray. Each step is better and
// costs more than the one before (L. Bergman et al., Image Rendering by Adaptive Refinement,
// SIGGRAPH 1986; thesis, 4.1).

#include "renderer/image/image.hpp"
#include "renderer/trace/params.hpp"

namespace renderer {

enum class PreviewStep : std::uint8_t {
  points,   ///< corners of polygons and of the facets of spheres and cones
  edges,    ///< visible edges
  flat,     ///< facets of one colour, sampled at their middle
  gouraud,  ///< colours interpolated between the facets' corners
  phong,    ///< illumination of the object itself at every pixel, without shadows
  shadows   ///< `phong` with a shadow feeler to every light
};

/// By their names above.
const base::Names<PreviewStep>& preview_steps();

/// Work of a preview except shading, which Work counts because the ray tracer's kernels do it.
/// `edges` draws facets twice: for hiding, and for their edges.
struct PreviewCounts {
  std::uint64_t vertices = 0;       ///< corners of facets, projected onto the image
  std::uint64_t facets = 0;         ///< drawn; not those on the far side of a sphere
  std::uint64_t pixels_tested = 0;  ///< compared with the z-buffer
  std::uint64_t pixels_drawn = 0;   ///< written, nearer than the previous content
  bool operator==(const PreviewCounts&) const = default;
};

struct Preview {
  Samples samples;  ///< of the whole image; 0 outside the area of interest
  /// The object that a pixel shows, by y * width + x, or NO_OBJECT.
  std::vector<std::uint32_t> objects;
  PreviewCounts counts;
  Work work;
};

/// Makes the preview of `params.area`, with the samples of render() and its direct light; reflected
/// and transmitted light is left out. Polygons and patches are exact. The facets of spheres and
/// cones change their outlines by at most half a pixel. `phong` and `shadows` compute the point on
/// the object that the z-buffer holds at a pixel. A pixel of `shadows` equals that of render() with
/// limits.depth 1 if both show the same object. Points and edges have the colour of their surface
/// and fade into the background with distance. The limits have no effect. BadInput as check().
Preview make_preview(const Scene& scene, const Params& params, PreviewStep step);

}  // namespace renderer
