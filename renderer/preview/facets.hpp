#pragma once
// Tessellation of objects into flat facets, for renderers that draw only polygons.

#include "renderer/trace/raster.hpp"

namespace renderer {

/// The facets of one object.
struct Facets {
  struct Corner {
    Vec at;
    Vec normal;  ///< unit outward normal of the object itself, not of a facet
  };
  std::vector<Corner> corners;
  std::vector<std::uint32_t> indices;  ///< corner numbers, one facet after the other
  std::vector<std::uint32_t> ends;     ///< end of each facet in `indices`
};

/// Fineness of the tessellation of spheres and cones. Polygons and patches are one facet.
enum class Fineness : std::uint8_t {
  outline,    ///< edges about ten pixels apart, 4 to 24 of them around the object
  silhouette  ///< inscribed facets; outlines in the image are at most half a pixel off the object's
};

/// Largest number of facets around a sphere or cone, however near it is.
inline constexpr int MAX_AROUND = 1024;

/// Tessellates the object at `place` for the image of `params`, and overwrites `facets`. Sines are
/// rounded to float, so that the facets do not depend on the maths library.
void make_facets(const Scene& scene, Place place, const Params& params, Fineness fineness,
                 Facets& facets);

}  // namespace renderer
