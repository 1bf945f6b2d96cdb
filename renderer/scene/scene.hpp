#pragma once
// A scene: surfaces, lights, a view, primitives by kind, and the hierarchy over them.

#include <cstdint>
#include <vector>

#include "renderer/scene/hierarchy.hpp"
#include "renderer/scene/primitives.hpp"
#include "renderer/scene/texture.hpp"

namespace renderer {

/// NFF's `f`. Reflected and transmitted light is not tinted: kr = ks and kt = t, for all colours.
struct Surface {
  Rgb colour{1, 1, 1};
  double kd = 1;     ///< diffuse, 0..1; also the ambient coefficient, ka = kd * colour
  double ks = 0;     ///< specular, 0..1
  double shine = 0;  ///< Phong's exponent, >= 0
  double t = 0;      ///< transmitted, 0..1
  double ior = 1;    ///< index of refraction relative to outside; > 0 if t > 0
  /// Radius of the disc over which reflected rays spread, across the mirrored ray at distance 1,
  /// 0..1; 0: a mirror. (R. Cook et al., 1984.)
  double gloss = 0;
  double translucency = 0;             ///< the same for transmitted rays
  std::uint32_t texture = NO_TEXTURE;  ///< index in Scene::textures; its colour times `colour`
};

enum class LightShape : std::uint8_t { point, rectangle, sphere };

/// Lights are invisible, and do not weaken with distance. All points of a rectangle or a sphere
/// emit equally in all directions.
struct Light {
  Vec at;  ///< its middle
  Rgb intensity{1, 1, 1};
  LightShape shape = LightShape::point;
  Vec u{}, v{};       ///< of a rectangle: from its middle to two edges' middles
  double radius = 0;  ///< of a sphere
};

/// A thin lens centred on the view point (M. Potmesil and I. Chakravarty, 1981).
struct Lens {
  double aperture = 0;  ///< diameter, scene units, >= 0; 0: a pinhole, all is in focus
  double focus = 1;  ///< distance along the view to the plane in focus, scene units, from MIN_FOCUS
};
inline constexpr double MIN_FOCUS = 1e-9;
/// Maximum factor for the aperture in a rendering.
inline constexpr double MAX_LENS = 10;

/// Maximum number of pixels along an image's side.
inline constexpr int MAX_SIDE = 65536;

/// NFF's `v`. The angle spans the height of the image; pixels are square.
struct View {
  Vec from{0, 0, 1}, at{0, 0, 0}, up{0, 1, 0};
  double angle = 45;              ///< degrees, 0..180 exclusive
  double hither = 0;              ///< has no effect: rays start at `from`
  int width = 512, height = 512;  ///< resolution from the file, pixels
  Lens lens{};
  Vec from_move{}, at_move{};  ///< of `from` and `at` while the shutter is open, scene units
  // Derived by make_image_plane():
  Vec right{}, above{}, ahead{};  ///< unit, of the image plane
  double half_height = 0;         ///< of the image plane at distance 1
  bool has_motion =
      false;  ///< derived by finish(): the view or an object moves while the shutter is open
};

enum class Kind : std::uint8_t { sphere, polygon, patch, cone };

/// Storage location of an object: a kind and an index, in 32 bits.
struct Place {
  std::uint32_t bits = 0;
  static Place of(Kind kind, std::size_t index) {
    return {static_cast<std::uint32_t>(index) << 2 | static_cast<std::uint32_t>(kind)};
  }
  Kind kind() const { return static_cast<Kind>(bits & 3); }
  std::uint32_t index() const { return bits >> 2; }
};

/// Fill the lists with the add_ functions, then call finish(), again after each translate().
struct Scene {
  std::vector<Surface> surfaces;
  std::vector<Light> lights;
  Rgb background;
  View view;
  std::vector<Place> objects;  ///< in file order
  // Primitives by kind; after finish() in the order of the hierarchy's leaves.
  std::vector<Sphere> spheres;
  std::vector<Polygon> polygons;
  std::vector<Patch> patches;
  std::vector<Cone> cones;
  std::vector<Corner> corners;  ///< of polygons and patches
  std::vector<Vec> normals;     ///< of patches' corners
  std::vector<Texture> textures;
  std::vector<Pyramid> pyramids;  ///< their pictures
  /// (u, v, 1) of corners, by their index in `corners`, for polygons and patches with a texture by
  /// coordinates; entries of others are undefined or missing.
  std::vector<Vec> coordinates;
  /// Displacement of each object while the shutter is open, by its index; empty: no motion. The
  /// primitives are stored as they are when it opens.
  std::vector<Vec> moves;
  /// Displacement by translate() of each object and its texture, by its index; empty: none.
  std::vector<Vec> displacements;
  Hierarchy hierarchy;  ///< a leaf's item is a Place's bits
  double epsilon = 0;   ///< least distance of a hit: 1e-10 of the largest coordinate
};

/// Calls `f` with the Sphere, Polygon, Patch or Cone at a place. Inlined like the kernels.
template <class F>
[[gnu::always_inline]] inline auto visit(const Scene& scene, Place place, const F& f) {
  switch (place.kind()) {
    case Kind::sphere:
      return f(scene.spheres[place.index()]);
    case Kind::polygon:
      return f(scene.polygons[place.index()]);
    case Kind::patch:
      return f(scene.patches[place.index()]);
    default:
      return f(scene.cones[place.index()]);
  }
}

// Each adds an object with the surface added last. BadInput for a degenerate shape, for a scene
// without surfaces, beyond 2^30 objects, and for a missing texture coordinate at any corner if the
// surface's texture needs them.
void add_sphere(Scene& scene, const Vec& centre, double radius);
void add_polygon(Scene& scene, std::span<const Vec> corners,
                 std::span<const Corner> coordinates = {});
void add_patch(Scene& scene, std::span<const Vec> corners, std::span<const Vec> normals,
               std::span<const Corner> coordinates = {});
void add_cone(Scene& scene, const Vec& base, double base_radius, const Vec& apex,
              double apex_radius);

/// Moves an object; call finish() afterwards.
void translate(Scene& scene, std::uint32_t object, const Vec& by);

/// Derives right, above and ahead from `from`, `at` and `up`, which must be valid.
void point(View& view);
/// The view with its derived fields; BadInput for an impossible one.
View make_image_plane(View view);

/// Derives the view's image plane, the hierarchy and epsilon. Boxes grow by 1e-12 of the largest
/// coordinate, so that rounding never makes a ray miss the box of an object that it hits. BadInput
/// for a view that is impossible at any time while the shutter is open.
void finish(Scene& scene);

/// The texture coordinates of a point of an object, given where it was when the shutter opened.
TexturePoint find_texture_point(const Scene& scene, const Texture& texture, std::uint32_t object,
                                const Vec& point);

/// Displacement of an object since the shutter opened, in a scene with `moves`, after a fraction
/// `time` of the shutter's time.
inline Vec eval_shift(const Scene& scene, std::uint32_t object, double time) {
  return time * scene.moves[object];
}

inline std::size_t object_count(const Scene& scene) { return scene.objects.size(); }
/// Number of boxes tested against rays; an object has no box of its own.
inline std::size_t box_count(const Scene& scene) {
  return scene.hierarchy.boxes.size() - scene.objects.size();
}

}  // namespace renderer
