#pragma once
// A ray, which carries its influence factor and its sample, so that any processor can trace it at
// any time and in any order (thesis, 4.3); and what it meets.

#include <cstdint>
#include <limits>

#include "renderer/scene/vec.hpp"

namespace renderer {

enum class RayKind : std::uint8_t { primary, reflected, transmitted, shadow };

/// The object of a ray that starts on none.
inline constexpr std::uint32_t NO_OBJECT = std::numeric_limits<std::uint32_t>::max();

struct Ray {
  Vec origin;
  Vec direction;  ///< unit length
  Rgb influence;  ///< share of this ray's intensity in its sample: f of Eq 4.15, fS of Eq 4.17
  /// Distance from which on hits do not matter: a feeler's to its light.
  double reach = std::numeric_limits<double>::infinity();
  std::uint32_t sample = 0;        ///< y * width + x
  std::uint32_t from = NO_OBJECT;  ///< object that the origin lies on
  std::uint16_t level = 1;         ///< depth in the shading tree, 1 = primary; a feeler is one
                                   ///< deeper than the ray whose hit it leaves
  std::uint16_t light = 0;         ///< index of the light that a feeler looks for
  RayKind kind = RayKind::primary;
  bool through = false;  ///< whether it, or an ancestor, was transmitted
};

/// The influence factor that limits are compared with.
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
