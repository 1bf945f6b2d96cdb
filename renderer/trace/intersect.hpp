#pragma once
// Rays, and the search for their first hit. A ray carries its influence factor and the number of
// its sample, so that any processor can trace it at any time and in any order (thesis, 4.3).

#include <optional>

#include "renderer/scene/scene.hpp"
#include "renderer/scene/work.hpp"

namespace renderer {

/// The kind of a ray. A probe is a ray from the eye that belongs to no sample (see make_probe()).
enum class RayKind : std::uint8_t { primary, reflected, transmitted, shadow, probe };

/// The value of Ray::from for a ray that does not start on an object.
inline constexpr std::uint32_t NO_OBJECT = std::numeric_limits<std::uint32_t>::max();

struct Ray {
  Vec origin;
  Vec direction;  ///< unit vector
  Rgb influence;  ///< factor on this ray's intensity in its sample: f of Eq 4.15, fS of Eq 4.17
  /// Hits at or beyond this distance are ignored. For a shadow feeler, the distance to its light.
  double reach = std::numeric_limits<double>::infinity();
  std::uint32_t sample = 0;        ///< number of the ray's pixel, y * width + x
  std::uint32_t from = NO_OBJECT;  ///< number of the object on which the ray starts
  /// Depth in the shading tree; 1 for the ray from the eye. A shadow feeler is one level deeper
  /// than the ray that it descends from.
  std::uint16_t level = 1;
  std::uint16_t light = 0;  ///< for a shadow feeler: index of its light
  RayKind kind = RayKind::primary;
  bool through = false;  ///< this ray, or one from which it descends, was transmitted
  /// The ray's image cell has more detail than its neighbours (see farm::CellOrder).
  bool is_urgent = false;
  /// Number of the user's order that admitted this ray or one from which it descends; 0 if none.
  std::uint8_t order = 0;
  std::uint16_t pass = 0;  ///< number of the ray's sample in its pixel, from 0
  /// Position in the shading tree of the sample. The ray's random numbers depend on it.
  std::uint32_t path = 1;
  float time = 0;       ///< fraction of the shutter's time that has passed, 0..1
  float travelled = 0;  ///< length of the path from the eye to the ray's origin, in scene units
};

/// The largest component of the influence factor, which is compared with limits.
inline double max_influence(const Ray& ray) { return max_component(ray.influence); }

struct Hit {
  double distance = 0;  ///< along the ray, in scene units
  Vec point;
  Vec normal;                 ///< unit vector, on the side from which the ray came
  std::uint32_t surface = 0;  ///< index of the surface in Scene::surfaces
  std::uint32_t object = 0;   ///< number of the object, in file order
  /// True if the ray met the back of the surface, that is, if it leaves the object.
  bool inside = false;
};

/// How the hierarchy is traversed. This affects the work, but not the hit.
enum class Traversal : std::uint8_t {
  /// As in the thesis: tests boxes in stored order, even those beyond the nearest hit so far. Every
  /// ray, including shadow feelers, searches for its first intersection.
  exhaustive,
  /// Skips boxes beyond the nearest hit so far or the ray's reach. A shadow feeler stops at any
  /// hit.
  nearest,
  linear  ///< tests every primitive, without boxes
};

/// A callback for scenes that are only partly in memory. It is called before each part of the scene
/// is read, and returns when this part may be read. `done` has the operations counted so far. The
/// search keeps a copy of the nearest object so far, and does not read it again to compute the
/// normal.
struct Access {
  virtual ~Access() = default;
  /// `index` is an index into Hierarchy::boxes, but never that of a leaf.
  virtual void box(std::uint32_t index, const Work& done) = 0;
  virtual void object(Place place, const Work& done) = 0;
};

/// Finds the nearest hit at a distance below the ray's reach. If distances are equal, the object
/// with the lowest number counts. For a shadow feeler with Traversal::nearest, returns any hit.
///
/// The direction must be a unit vector. The ray must start inside the scene's bounds or at its view
/// point; otherwise rounding could make it miss boxes (see finish()). Ignores hits at the ray's
/// start: those on the object `ray.from`, and those within eval_epsilon() (see primitives.hpp).
/// Adds the operations to `work`. Calls `access`, unless null, before each read; this changes
/// neither hit nor work. Thread-safe.
std::optional<Hit> intersect(const Scene& scene, const Ray& ray, Traversal traversal, Work& work,
                             Access* access = nullptr);

/// Finds the hit on a single object, as if the scene had no other. Does not count as a call of
/// intersect() in `work`.
std::optional<Hit> intersect_object(const Scene& scene, const Ray& ray, Place place, Work& work);

}  // namespace renderer
