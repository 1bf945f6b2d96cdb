#pragma once
// Preview pictures of a scene, drawn with a z-buffer instead of rays from the eye. Each PreviewStep
// gives a better and more expensive picture than the one before (L. Bergman et al., Image Rendering
// by Adaptive Refinement, SIGGRAPH 1986; thesis, 4.1).

#include "renderer/image/image.hpp"
#include "renderer/trace/params.hpp"

namespace renderer {

enum class PreviewStep : std::uint8_t {
  points,   ///< corners of polygons and of the facets of spheres and cones
  edges,    ///< visible edges of polygons and of the facets of spheres and cones
  flat,     ///< flat shading: one colour per facet, computed at its middle
  gouraud,  ///< colours interpolated between the corners of facets
  phong,    ///< illumination computed at every pixel, without shadows
  shadows   ///< as `phong`, with shadows: a ray to every light
};

/// Names of the steps in options.
const base::Names<PreviewStep>& preview_steps();

/// Work of a preview without shading. (The ray tracer's functions shade, and count their work in
/// Work.) PreviewStep::edges draws all facets twice: into the z-buffer, and as edges.
struct PreviewCounts {
  std::uint64_t vertices = 0;       ///< facet corners projected onto the image
  std::uint64_t facets = 0;         ///< facets drawn; the far side of a sphere is not drawn
  std::uint64_t pixels_tested = 0;  ///< pixels whose depth was compared with the z-buffer
  /// Pixels written because they were nearer than the previous content.
  std::uint64_t pixels_drawn = 0;
  bool operator==(const PreviewCounts&) const = default;
};

struct Preview {
  Samples samples;  ///< colours of the whole image; 0 outside the area of interest
  /// The number of the object that each pixel shows, at y * width + x; NO_OBJECT for none.
  std::vector<std::uint32_t> objects;
  PreviewCounts counts;
  Work work;
};

/// Makes the preview of `params.area` with the sample positions of render(). Only direct light is
/// shown, without reflection and transmission; `params.limits` has no effect. Polygons and patches
/// are exact. The facets of spheres and cones shift outlines by at most half a pixel. Points and
/// edges have the colour of their surface and fade into the background with distance.
///
/// `phong` and `shadows` find the object at each pixel with the z-buffer, then compute the exact
/// point on it. A pixel of `shadows` equals that of render() with limits.depth 1 if both show the
/// same object. Throws BadInput as check() does.
Preview make_preview(const Scene& scene, const Params& params, PreviewStep step);

}  // namespace renderer
