#pragma once
// Rays and their first hit. A ray carries its influence factor and its sample, so that any
// processor can trace it at any time and in any order (thesis, 4.3).

#include <optional>

#include "renderer/scene/scene.hpp"
#include "renderer/scene/work.hpp"

namespace renderer {

/// Kind of a ray. A probe is a primary ray that belongs to no sample (see make_probe()).
enum class RayKind : std::uint8_t { primary, reflected, transmitted, shadow, probe };

/// The value of `from` for a ray that starts on no object.
inline constexpr std::uint32_t NO_OBJECT = std::numeric_limits<std::uint32_t>::max();

struct Ray {
  Vec origin;
  Vec direction;  ///< direction of unit length
  Rgb influence;  ///< factor of this ray's intensity in its sample: f of Eq 4.15, fS of Eq 4.17
  /// Distance at and beyond which hits are ignored. For a feeler, the distance to its light.
  double reach = std::numeric_limits<double>::infinity();
  std::uint32_t sample = 0;        ///< pixel, as y * width + x
  std::uint32_t from = NO_OBJECT;  ///< object that the origin lies on
  /// depth in the shading tree, 1 = primary; a feeler is one deeper than its parent ray
  std::uint16_t level = 1;
  std::uint16_t light = 0;  ///< index of the feeler's light
  RayKind kind = RayKind::primary;
  bool through = false;  ///< true if this ray or an ancestor was transmitted
  /// true if the ray's cell shows more detail than its neighbours (see farm::CellOrder)
  bool is_urgent = false;
  /// number of the user's order that admitted this ray or an ancestor; 0: none
  std::uint8_t order = 0;
  std::uint16_t pass = 0;  ///< index of the ray's sample in the pixel, from 0
  /// position in the shading tree of the sample, from which the ray's random numbers follow
  std::uint32_t path = 1;
  float time = 0;       ///< fraction of the shutter's time, 0..1
  float travelled = 0;  ///< length of the path from the eye to the ray's origin, scene units
};

/// The influence factor that is compared with limits: the largest component.
inline double max_influence(const Ray& ray) { return max_component(ray.influence); }

struct Hit {
  double distance = 0;  ///< distance along the ray, in scene units
  Vec point;
  Vec normal;                 ///< unit vector on the side that the ray came from
  std::uint32_t surface = 0;  ///< surface that was hit, in Scene::surfaces
  std::uint32_t object = 0;   ///< object that was hit, numbered in file order
  /// true if the ray met the back of the surface, so that it leaves the object
  bool inside = false;
};

/// Traversal of the hierarchy. It affects the work, but not the hit.
enum class Traversal : std::uint8_t {
  /// As in the thesis: boxes in stored order, not clipped by the nearest hit so far. Every ray,
  /// feelers included, searches for its first intersection.
  exhaustive,
  /// boxes clipped by the nearest hit so far and the ray's reach; a feeler stops at any hit
  nearest,
  linear  ///< tests every primitive, without boxes
};

/// Callback for the parts of a scene that a search reads, for scenes that are only partly in
/// memory. It is called before each test, and returns when the part may be read. `done` has the
/// counts of the kernel before the test. The search keeps a copy of the nearest object so far, and
/// does not read it again for the normal.
struct Access {
  virtual ~Access() = default;
  /// `index` refers to Hierarchy::boxes, and never to a leaf.
  virtual void box(std::uint32_t index, const Work& done) = 0;
  virtual void object(Place place, const Work& done) = 0;
};

/// Finds the nearest hit closer than the ray's reach. If distances are equal, the object with the
/// lowest number counts. A shadow feeler under Traversal::nearest returns any blocking hit. The ray
/// must have a unit direction, and start in the scene's bounds or at its view point. (Otherwise
/// rounding could make it miss boxes, see finish().) Hits at the ray's start are ignored: those on
/// object `ray.from`, and those within eval_epsilon() (see primitives.hpp). Adds to `work`. Calls
/// `access`, unless null, for each read, without effect on hit and work. Thread-safe.
std::optional<Hit> intersect(const Scene& scene, const Ray& ray, Traversal traversal, Work& work,
                             Access* access = nullptr);

/// Finds the hit on a single object, as if it were alone. Does not count as a call of intersect().
std::optional<Hit> intersect_object(const Scene& scene, const Ray& ray, Place place, Work& work);

}  // namespace renderer
