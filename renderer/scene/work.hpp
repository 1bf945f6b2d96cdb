#pragma once
// Counts of the operations of the rendering functions. The machine model converts them to cycles.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace renderer {

enum class Op : std::uint8_t {
  box_test,       ///< a ray tested against one bounding box
  sphere_test,    ///< a ray tested against one sphere
  sphere_root,    ///< a sphere test whose equation has a solution: the ray's line meets the sphere
  polygon_test,   ///< a ray tested against the plane of one polygon
  patch_test,     ///< a ray tested against the plane of one polygon with normals (Patch)
  polygon_edges,  ///< a point-in-polygon test, made if the plane is ahead of the ray
  cone_test,      ///< a ray tested against one cone or cylinder
  ray_intersected,  ///< one call of intersect()
  hit_made,         ///< a hit with point and normal; rays to lights do not need them
  surface_shaded,   ///< one hit for which make_children() makes rays
  feeler_made,      ///< a ray to a light (shadow feeler) made, with its influence factor (Eq 4.17)
  ray_reflected,    ///< a reflected ray made
  ray_refracted,    ///< a transmitted ray made
  texture_mapped,   ///< a texture point found, with the size of a pixel there
  texel_mixed,      ///< a texel read and mixed with its neighbours
  sample_updated,   ///< a contribution added to a sample (Eq 4.26)
  pixel_drawn,      ///< a pixel of a cell written to the display memory
  pixel_interpolated,  ///< a pixel interpolated between samples
  factor_begun,        ///< radiosity: test whether a vertex and a patch face each other
  delta_area,  ///< radiosity: a part of a patch evaluated: distance, cosines, quotient (Eq 3.8)
  /// a point mirrored, or the point found at which a path meets a mirror (Eq 3.17)
  light_mirrored,
  vertex_lit,      ///< radiosity of a vertex updated (Eq 3.9)
  patch_lit,       ///< unsent light of a patch updated by its mean received light
  patch_compared,  ///< unsent light of a patch compared with the largest so far
  glow_found,      ///< radiosity at a delta area evaluated, if it varies over the patch
  corner_lit,      ///< unsent light at a patch's corner updated
  COUNT
};

inline constexpr std::size_t OP_COUNT = static_cast<std::size_t>(Op::COUNT);

struct Work {
  std::array<std::uint64_t, OP_COUNT> counts{};

  std::uint64_t& operator[](Op op) { return counts[static_cast<std::size_t>(op)]; }
  std::uint64_t operator[](Op op) const { return counts[static_cast<std::size_t>(op)]; }
  Work& operator+=(const Work& other) {
    for (std::size_t i = 0; i < OP_COUNT; ++i) counts[i] += other.counts[i];
    return *this;
  }
  bool operator==(const Work&) const = default;
};

/// Names of the operations in model files and reports, in the order of the enum Op.
inline std::span<const std::string_view> op_names() {
  static constexpr std::array<std::string_view, OP_COUNT> NAMES = {
      "box_test",       "sphere_test",   "sphere_root",        "polygon_test",   "patch_test",
      "polygon_edges",  "cone_test",     "ray_intersected",    "hit_made",       "surface_shaded",
      "feeler_made",    "ray_reflected", "ray_refracted",      "texture_mapped", "texel_mixed",
      "sample_updated", "pixel_drawn",   "pixel_interpolated", "factor_begun",   "delta_area",
      "light_mirrored", "vertex_lit",    "patch_lit",          "patch_compared", "glow_found",
      "corner_lit"};
  static_assert(!NAMES.back().empty(), "an Op has no name here");
  return NAMES;
}

}  // namespace renderer
