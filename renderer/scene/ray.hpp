#pragma once
// A ray on its own: with its influence factor and its sample it can be traced by anyone, at any
// time and in any order (thesis, 4.3). And what it meets.

#include <cstdint>
#include <limits>

#include "renderer/scene/vec.hpp"

namespace renderer {

enum class RayKind : std::uint8_t { primary, reflected, transmitted, shadow };

/// The object a ray starts on when it starts on none.
inline constexpr std::uint32_t NO_OBJECT = std::numeric_limits<std::uint32_t>::max();

struct Ray {
  Vec origin;
  Vec direction;  ///< unit length
  Rgb influence;  ///< share of this ray's intensity in its sample: f of Eq 4.15, fS of Eq 4.17
  double reach = std::numeric_limits<double>::infinity();  ///< hits at or beyond it do not matter:
                                                           ///< a feeler's distance to its light
  std::uint32_t sample = 0;                                ///< y * width + x
  std::uint32_t from = NO_OBJECT;                          ///< object the origin lies on
  std::uint16_t level = 1;  ///< depth in the shading tree, 1 = primary; a feeler is one
                            ///< deeper than the ray whose hit it leaves
  std::uint16_t light = 0;  ///< of a feeler: the light it looks for
  RayKind kind = RayKind::primary;
  bool through = false;  ///< it, or an ancestor, was transmitted
};

/// The largest of the three influence factors, which limits are compared with.
inline double max_influence(const Ray& ray) { return max_component(ray.influence); }

struct Hit {
  double distance = 0;  ///< along the ray, in scene units
  Vec point;
  Vec normal;                 ///< unit, on the side the ray came from
  std::uint32_t surface = 0;  ///< index into Scene::surfaces
  std::uint32_t object = 0;   ///< index in file order
  bool inside = false;        ///< the ray met the back of the surface: it leaves the object
};

}  // namespace renderer
