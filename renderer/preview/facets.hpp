#pragma once
// Objects as flat facets, for renderers that draw only polygons.

#include "renderer/trace/raster.hpp"

namespace renderer {

/// The facets of one object.
struct Facets {
  struct Corner {
    Vec at;
    Vec normal;  ///< of the object itself, unit, outwards
  };
  std::vector<Corner> corners;
  std::vector<std::uint32_t> indices;  ///< of the facets' corners, one facet after the other
  std::vector<std::uint32_t> ends;     ///< end of each facet in `indices`
};

/// Subdivision of spheres and cones; polygons and patches are one facet.
enum class Fineness : std::uint8_t {
  outline,    ///< edges about ten pixels apart, 4 to 24 around
  silhouette  ///< inscribed facets, at most half a pixel off the object on the image
};

/// Maximum number of facets around a sphere or a cone, however near it is.
inline constexpr int MAX_AROUND = 1024;

/// Divides the object at `place` for the image of `params`; overwrites `facets`. Sines are rounded
/// to float, so that the facets do not depend on the maths library.
void make_facets(const Scene& scene, Place place, const Params& params, Fineness fineness,
                 Facets& facets);

}  // namespace renderer
