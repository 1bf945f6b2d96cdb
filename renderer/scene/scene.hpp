#pragma once
// A scene: surfaces, lights, a view, primitives by kind, and a bounding-volume hierarchy.

#include <cstdint>
#include <vector>

#include "renderer/scene/hierarchy.hpp"
#include "renderer/scene/primitives.hpp"
#include "renderer/scene/texture.hpp"

namespace renderer {

/// Surface of NFF's statement `f`. Reflected and transmitted light is not tinted: kr = ks and kt =
/// t, for all colours.
struct Surface {
  Rgb colour{1, 1, 1};
  double kd = 1;     ///< diffuse reflectance, 0..1; ka = kd * colour is the ambient coefficient
  double ks = 0;     ///< specular reflectance, 0..1
  double shine = 0;  ///< Phong exponent, >= 0
  double t = 0;      ///< transmittance, 0..1
  double ior = 1;    ///< index of refraction relative to outside; > 0 if t > 0
  /// Spread of reflected rays (R. Cook et al., 1984): the radius, 0..1, of a disc perpendicular to
  /// the mirrored ray at distance 1. 0: a mirror.
  double gloss = 0;
  double translucency = 0;  ///< spread of transmitted rays, as `gloss`
  /// texture in Scene::textures, which multiplies `colour`
  std::uint32_t texture = NO_TEXTURE;
};

enum class LightShape : std::uint8_t { point, rectangle, sphere };

/// A light. It is invisible, and its intensity does not decrease with distance. All points of a
/// rectangle or a sphere emit equally in all directions.
struct Light {
  Vec at;  ///< position of the light's middle
  Rgb intensity{1, 1, 1};
  LightShape shape = LightShape::point;
  Vec u{}, v{};       ///< for a rectangle: vectors from the middle to the middles of two edges
  double radius = 0;  ///< radius of a spherical light
};

/// A thin lens centred on the view point (M. Potmesil and I. Chakravarty, 1981).
struct Lens {
  double aperture = 0;  ///< diameter, scene units, >= 0; 0: a pinhole, everything is in focus
  /// distance along the view to the plane in focus, scene units, at least MIN_FOCUS
  double focus = 1;
};
inline constexpr double MIN_FOCUS = 1e-9;
/// Largest factor on the aperture in a rendering.
inline constexpr double MAX_LENS = 10;

/// Limit on the width and height of an image, pixels.
inline constexpr int MAX_SIDE = 65536;

/// View of NFF's statement `v`. The angle spans the height of the image; pixels are square.
struct View {
  Vec from{0, 0, 1}, at{0, 0, 0}, up{0, 1, 0};
  double angle = 45;              ///< viewing angle in degrees, between 0 and 180
  double hither = 0;              ///< has no effect: rays start at `from`
  int width = 512, height = 512;  ///< resolution stated in the file, pixels
  Lens lens{};
  /// displacement of `from` and `at` while the shutter is open, scene units
  Vec from_move{}, at_move{};
  // Derived by make_image_plane():
  Vec right{}, above{}, ahead{};  ///< unit axes of the image plane
  double half_height = 0;         ///< half height of the image plane at distance 1
  /// derived by finish(): true if the view or an object moves while the shutter is open
  bool has_motion = false;
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

/// The scene's lists. The add_ functions fill them; then call finish(). Call it again after
/// translate().
struct Scene {
  std::vector<Surface> surfaces;
  std::vector<Light> lights;
  Rgb background;
  View view;
  std::vector<Place> objects;  ///< locations of the objects, in file order
  // Primitives by kind. finish() sorts them in the order of the hierarchy's leaves.
  std::vector<Sphere> spheres;
  std::vector<Polygon> polygons;
  std::vector<Patch> patches;
  std::vector<Cone> cones;
  std::vector<PolygonCorner> corners;  ///< corners of polygons and patches
  std::vector<Vec> normals;            ///< normals at the corners of patches
  std::vector<Texture> textures;
  std::vector<Pyramid> pyramids;  ///< pictures of the textures
  /// Texture coordinates (u, v, 1) of corners, by their index in `corners`, for polygons and
  /// patches whose texture needs them. The entries of other corners are undefined or missing.
  std::vector<Vec> coordinates;
  /// Displacement of each object while the shutter is open; empty: no motion. Primitives are stored
  /// as they are when it opens.
  std::vector<Vec> moves;
  /// Displacement by translate() of each object and its texture; empty: none.
  std::vector<Vec> displacements;
  Hierarchy hierarchy;       ///< the `item` of a leaf has the bits of a Place
  double epsilon = 0;        ///< 1e-10 of the largest coordinate, see eval_epsilon()
  double least_epsilon = 0;  ///< 1e-10 of the size of the smallest object
};

/// Generous bound on the rounding error of a ray's origin, relative to the coordinates that it
/// depends on.
inline constexpr double SELF_RELATIVE = 1e-10;

/// Least distance of a hit for a ray that starts at `origin`, after a path of length `travelled`
/// from the eye. It grows with the coordinates on this path. Huge objects elsewhere do not matter.
inline double eval_epsilon(const Scene& scene, const Vec& origin, double travelled) {
  const double local = SELF_RELATIVE * std::max(max_abs(origin), travelled);
  return std::min(std::max(local, scene.least_epsilon), scene.epsilon);
}

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

// Functions that add an object with the latest surface. They throw BadInput for a degenerate shape,
// a scene without surfaces, and more than 2^30 objects. They also throw it if the surface's texture
// needs coordinates and a corner has none.
void add_sphere(Scene& scene, const Vec& centre, double radius);
void add_polygon(Scene& scene, std::span<const Vec> corners,
                 std::span<const Corner> coordinates = {});
void add_patch(Scene& scene, std::span<const Vec> corners, std::span<const Vec> normals,
               std::span<const Corner> coordinates = {});
void add_cone(Scene& scene, const Vec& base, double base_radius, const Vec& apex,
              double apex_radius);

/// Moves an object. Call finish() afterwards.
void translate(Scene& scene, std::uint32_t object, const Vec& by);

/// Derives right, above and ahead from `from`, `at` and `up`, which must be valid.
void point(View& view);
/// Returns the view with its derived fields. Throws BadInput for an impossible view.
View make_image_plane(View view);

/// Derives the image plane of the view, the hierarchy, epsilon and least_epsilon. Boxes grow by
/// 1e-12 of the largest coordinate, so that rounding never makes a ray miss the box of an object
/// that it hits. Throws BadInput for a view that is impossible at any time while the shutter is
/// open.
void finish(Scene& scene);

/// The texture coordinates at a point of an object, which is given as it was when the shutter
/// opened.
TexturePoint find_texture_point(const Scene& scene, const Texture& texture, std::uint32_t object,
                                const Vec& point);

/// Displacement of an object since the shutter opened, after a fraction `time` of the shutter's
/// time. The scene must have `moves`.
inline Vec eval_shift(const Scene& scene, std::uint32_t object, double time) {
  return time * scene.moves[object];
}

inline std::size_t object_count(const Scene& scene) { return scene.objects.size(); }
/// Number of boxes that are tested against rays. Objects have no boxes of their own.
inline std::size_t box_count(const Scene& scene) {
  return scene.hierarchy.boxes.size() - scene.objects.size();
}

}  // namespace renderer
