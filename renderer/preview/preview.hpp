#pragma once
// Preview pictures of a scene by z-buffer, without rays from the eye. Each step is better and more
// expensive than the one before (L. Bergman et al., Image Rendering by Adaptive Refinement,
// SIGGRAPH 1986; thesis, 4.1).

#include "renderer/image/image.hpp"
#include "renderer/trace/params.hpp"

namespace renderer {

enum class PreviewStep : std::uint8_t {
  points,   ///< corners of polygons and of the facets of spheres and cones
  edges,    ///< visible edges
  flat,     ///< flat shading: one colour per facet, sampled at its middle
  gouraud,  ///< colours interpolated between the corners of facets
  phong,    ///< illumination of the object itself at every pixel, without shadows
  shadows   ///< `phong` with a shadow feeler to every light
};

/// The steps by name.
const base::Names<PreviewStep>& preview_steps();

/// Work of a preview except for shading. (Shading is done by the ray tracer's kernels, which count
/// it in Work.) PreviewStep::edges draws all facets twice: for the z-buffer, and for their edges.
struct PreviewCounts {
  std::uint64_t vertices = 0;       ///< facet corners projected onto the image
  std::uint64_t facets = 0;         ///< facets drawn, without those on the far side of a sphere
  std::uint64_t pixels_tested = 0;  ///< pixels compared with the z-buffer
  std::uint64_t pixels_drawn = 0;   ///< pixels written, nearer than the previous content
  bool operator==(const PreviewCounts&) const = default;
};

struct Preview {
  Samples samples;  ///< samples of the whole image; 0 outside the area of interest
  /// Object shown by each pixel, at y * width + x, or NO_OBJECT.
  std::vector<std::uint32_t> objects;
  PreviewCounts counts;
  Work work;
};

/// Makes the preview of `params.area` with the sample positions of render(). It has direct light
/// only, without reflection and transmission; the limits have no effect. Polygons and patches are
/// exact. The facets of spheres and cones shift outlines by at most half a pixel. Points and edges
/// have the colour of their surface and fade into the background with distance. `phong` and
/// `shadows` compute the exact point of the object that the z-buffer holds at a pixel. A pixel of
/// `shadows` equals that of render() with limits.depth 1 if both show the same object. Throws
/// BadInput as check() does.
Preview make_preview(const Scene& scene, const Params& params, PreviewStep step);

}  // namespace renderer
