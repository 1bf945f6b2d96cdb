#pragma once
// Tessellation of objects into flat facets, for renderers that can draw only polygons.

#include "renderer/trace/raster.hpp"

namespace renderer {

/// The facets of one object.
struct Facets {
  struct Corner {
    Vec at;
    Vec normal;  ///< unit normal of the curved object, not of a facet; points outwards
  };
  std::vector<Corner> corners;
  std::vector<std::uint32_t> indices;  ///< corner numbers of all facets, one facet after the other
  std::vector<std::uint32_t> ends;     ///< by facet: where its corner numbers end in `indices`
};

/// Fineness of the tessellation of spheres and cones. A polygon or patch is always one facet.
enum class Fineness : std::uint8_t {
  outline,  ///< edges are about ten pixels apart, with 4 to 24 edges around the object
  /// The object's outline in the image is exact to half a pixel; facets are inside the object.
  silhouette
};

/// Largest number of facets around a sphere or cone, even if it is close to the eye.
inline constexpr int MAX_AROUND = 1024;

/// Tessellates the object at `place` for an image with the parameters `params`. Overwrites
/// `facets`. Sines are rounded to float, so that the facets do not depend on the host's maths
/// library.
void make_facets(const Scene& scene, Place place, const Params& params, Fineness fineness,
                 Facets& facets);

}  // namespace renderer
