#pragma once
// Rays and their first hit. A ray carries its influence factor and its sample, so that any
// processor can trace it at any time and in any order (thesis, 4.3).

#include <optional>

#include "renderer/scene/scene.hpp"
#include "renderer/scene/work.hpp"

namespace renderer {

/// A probe is a primary ray without a sample, see make_probe().
enum class RayKind : std::uint8_t { primary, reflected, transmitted, shadow, probe };

/// The value of `from` for a ray that starts on no object.
inline constexpr std::uint32_t NO_OBJECT = std::numeric_limits<std::uint32_t>::max();

struct Ray {
  Vec origin;
  Vec direction;  ///< unit length
  Rgb influence;  ///< share of this ray's intensity in its sample: f of Eq 4.15, fS of Eq 4.17
  /// Hits at this distance or beyond are ignored: for a feeler, the distance to its light.
  double reach = std::numeric_limits<double>::infinity();
  std::uint32_t sample = 0;        ///< y * width + x
  std::uint32_t from = NO_OBJECT;  ///< object that the origin lies on
  std::uint16_t level = 1;         ///< depth in the shading tree, 1 = primary; a feeler is one
                                   ///< deeper than its parent ray
  std::uint16_t light = 0;         ///< index of the feeler's light
  RayKind kind = RayKind::primary;
  bool through = false;    ///< true if it, or an ancestor, was transmitted
  bool is_urgent = false;  ///< its cell shows more detail than its neighbours: see farm::CellOrder
  std::uint8_t order = 0;  ///< the user's order that admitted it or an ancestor; 0: none
  std::uint16_t pass = 0;  ///< index of its sample in the pixel, from 0
  std::uint32_t path = 1;  ///< position in the sample's shading tree, which seeds its random
                           ///< numbers
  float time = 0;          ///< fraction of the shutter's time, 0..1
  float travelled = 0;     ///< from the eye to its origin, along its ancestors, scene units
};

/// The influence factor that is compared with limits.
inline double max_influence(const Ray& ray) { return max_component(ray.influence); }

struct Hit {
  double distance = 0;  ///< along the ray, in scene units
  Vec point;
  Vec normal;                 ///< unit, on the side the ray came from
  std::uint32_t surface = 0;  ///< index into Scene::surfaces
  std::uint32_t object = 0;   ///< index in file order
  bool inside = false;        ///< the ray met the back of the surface: it leaves the object
};

/// Traversal of the hierarchy: it affects the work, but not the hit.
enum class Traversal : std::uint8_t {
  exhaustive,  ///< as in the thesis: boxes in stored order, not clipped by the nearest hit so far;
               ///< every ray searches for the first intersection, feelers included
  nearest,  ///< boxes clipped by the nearest hit so far and by the ray's reach; a feeler stops at
            ///< any hit
  linear    ///< every primitive, no boxes
};

/// Observer of the parts of a scene that a search reads, for scenes that are only partly in memory.
/// It is called before each test and returns when the part may be read. `done` has the kernel's
/// counts before this test. The nearest object so far is a copy: its normal is not read again.
struct Access {
  virtual ~Access() = default;
  /// `index` in Hierarchy::boxes; never a leaf.
  virtual void box(std::uint32_t index, const Work& done) = 0;
  virtual void object(Place place, const Work& done) = 0;
};

/// The nearest hit closer than the ray's reach, on the lowest object if distances are equal. A
/// shadow feeler under Traversal::nearest returns any blocking hit. The ray must start within the
/// scene's bounds or at its view point (rounding, see finish()), with a unit direction. It ignores
/// hits where it starts (on object `ray.from`, and within the scene's epsilon): see primitives.hpp.
/// Adds to `work`. Calls `access`, unless null, for each read, without effect on hit and work.
/// Thread-safe.
std::optional<Hit> intersect(const Scene& scene, const Ray& ray, Traversal traversal, Work& work,
                             Access* access = nullptr);

/// The same for a single object, as if it were alone; does not count a call of intersect().
std::optional<Hit> intersect_object(const Scene& scene, const Ray& ray, Place place, Work& work);

}  // namespace renderer
