#pragma once
// A ray, which carries its influence factor and its sample, so that any processor can trace it at
// any time and in any order (thesis, 4.3); and the first object on it.

#include <optional>

#include "renderer/scene/scene.hpp"
#include "renderer/scene/work.hpp"

namespace renderer {

/// A probe is a primary ray of no sample, see make_probe().
enum class RayKind : std::uint8_t { primary, reflected, transmitted, shadow, probe };

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
  bool through = false;    ///< whether it, or an ancestor, was transmitted
  bool is_urgent = false;  ///< its cell shows more than its neighbours: see farm::CellOrder
  std::uint8_t order = 0;  ///< of the user, that admitted it or an ancestor; 0: none
  std::uint16_t pass = 0;  ///< which of its pixel's samples it belongs to, from 0
  std::uint32_t path = 1;  ///< its place in the sample's shading tree, which its random numbers
                           ///< depend on
  float time = 0;          ///< share of the shutter's time that has passed, 0..1
  float travelled = 0;     ///< from the eye to its origin, along its ancestors, scene units
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

/// How the hierarchy is walked. The hit does not depend on it, only the work does.
enum class Traversal : std::uint8_t {
  exhaustive,  ///< as in the thesis: boxes in stored order, not clipped by the nearest hit so far;
               ///< the first intersection is searched for every ray, feelers included
  nearest,  ///< boxes clipped by the nearest hit so far and by the ray's reach; a feeler stops at
            ///< any hit
  linear    ///< every primitive, no boxes
};

/// Which parts of a scene a search reads, for scenes that are not all at hand: it is told of a part
/// before every test against it, and when it returns, the part may be read. `done` is all that the
/// kernel has counted until then, without this test. (A copy of the nearest object so far is kept:
/// its normal is not read again.)
struct Access {
  virtual ~Access() = default;
  /// `index` in Hierarchy::boxes; never a leaf.
  virtual void box(std::uint32_t index, const Work& done) = 0;
  virtual void object(Place place, const Work& done) = 0;
};

/// The nearest hit closer than the ray's reach; where hits are at equal distance, the one on the
/// lowest object. For a shadow feeler under Traversal::nearest it is any hit that blocks it. The
/// ray must start within the scene's bounds or at its view point (rounding, see finish()); its
/// direction is a unit vector. It does not meet the place where it starts (object `ray.from`, and
/// all within the scene's epsilon): see primitives.hpp. Adds to `work`. `access`, unless null, is
/// told what is read; it changes neither hit nor work. Thread-safe.
std::optional<Hit> intersect(const Scene& scene, const Ray& ray, Traversal traversal, Work& work,
                             Access* access = nullptr);

/// The same with one object alone, as if there were no others; no call of intersect() is counted.
std::optional<Hit> intersect_object(const Scene& scene, const Ray& ray, Place place, Work& work);

}  // namespace renderer
