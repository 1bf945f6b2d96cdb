#pragma once
// Objects as flat facets, for what draws polygons only.

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
  std::vector<std::uint32_t> ends;     ///< index in `indices` after each facet's last
};

/// How spheres and cones are divided; polygons and patches are one facet.
enum class Fineness : std::uint8_t {
  outline,    ///< edges about ten pixels apart, 4 to 24 around
  silhouette  ///< facets within the object, off it by at most half a pixel on the image
};

/// Most facets around a sphere or a cone, however near it is.
inline constexpr int MAX_AROUND = 1024;

/// Divides the object at `place` for the image of `raster`, `params.width` wide; overwrites
/// `facets`. Sines are rounded to float: the same facets whichever library computes them.
void make_facets(const Scene& scene, Place place, const Params& params, Fineness fineness,
                 Facets& facets);

}  // namespace renderer
