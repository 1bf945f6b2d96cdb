#pragma once
// A scene: surfaces, lights, a view, lists of primitives by kind, and a bounding-volume hierarchy.

#include <cstdint>
#include <vector>

#include "renderer/scene/hierarchy.hpp"
#include "renderer/scene/primitives.hpp"
#include "renderer/scene/texture.hpp"

namespace renderer {

/// The surface given by NFF's statement `f`. Reflected and transmitted light is not tinted: for all
/// colours, its coefficients kr and kt are `ks` and `t`.
struct Surface {
  Rgb colour{1, 1, 1};
  double kd = 1;     ///< diffuse reflectance, 0..1; kd * colour is also the ambient coefficient ka
  double ks = 0;     ///< specular reflectance, 0..1
  double shine = 0;  ///< Phong exponent, >= 0
  double t = 0;      ///< transmittance, 0..1
  double ior = 1;    ///< index of refraction relative to outside; > 0 if t > 0
  /// Spread of reflected rays (R. Cook et al., 1984). The rays go to points of a disc, which is
  /// perpendicular to the mirrored ray and at distance 1. This number is the disc's radius, 0..1; 0
  /// means a perfect mirror.
  double gloss = 0;
  double translucency = 0;  ///< spread of transmitted rays, with the meaning of `gloss`
  /// Index in Scene::textures of a texture that multiplies `colour`, or NO_TEXTURE.
  std::uint32_t texture = NO_TEXTURE;
};

enum class LightShape : std::uint8_t { point, rectangle, sphere };

/// A light. It is invisible, and its intensity does not decrease with distance. All points of a
/// rectangle or a sphere emit equally in all directions.
struct Light {
  Vec at;  ///< centre of the light
  Rgb intensity{1, 1, 1};
  LightShape shape = LightShape::point;
  Vec u{}, v{};       ///< for a rectangle: vectors from the centre to the middles of two edges
  double radius = 0;  ///< radius of a spherical light
};

/// A thin lens with its centre at the view point (M. Potmesil and I. Chakravarty, 1981).
struct Lens {
  /// Diameter in scene units, >= 0; 0: a pinhole, so that everything is in focus.
  double aperture = 0;
  /// Distance from the lens to the plane in focus, along the view, in scene units. At least
  /// MIN_FOCUS.
  double focus = 1;
};
inline constexpr double MIN_FOCUS = 1e-9;
/// Largest factor by which a rendering may multiply the aperture.
inline constexpr double MAX_LENS = 10;

/// Largest width and height of an image, in pixels.
inline constexpr int MAX_SIDE = 65536;

/// The view given by NFF's statement `v`. The angle spans the height of the image. Pixels are
/// square.
struct View {
  Vec from{0, 0, 1}, at{0, 0, 0}, up{0, 1, 0};
  double angle = 45;  ///< viewing angle in degrees, between 0 and 180
  /// Near clipping distance of NFF; has no effect, because rays start at `from`.
  double hither = 0;
  int width = 512, height = 512;  ///< resolution stated in the file, in pixels
  Lens lens{};
  /// Displacement of `from` and `at` while the shutter is open, in scene units.
  Vec from_move{}, at_move{};
  // Derived by make_image_plane():
  Vec right{}, above{}, ahead{};  ///< unit axes of the image plane
  double half_height = 0;         ///< half height of the image plane at distance 1
  /// Computed by finish(): true if the view or an object moves while the shutter is open.
  bool has_motion = false;
};

enum class Kind : std::uint8_t { sphere, polygon, patch, cone };

/// Where an object is stored: its kind, and its index in the list of this kind, in 32 bits.
struct Place {
  std::uint32_t bits = 0;
  static Place of(Kind kind, std::size_t index) {
    return {static_cast<std::uint32_t>(index) << 2 | static_cast<std::uint32_t>(kind)};
  }
  Kind kind() const { return static_cast<Kind>(bits & 3); }
  std::uint32_t index() const { return bits >> 2; }
};

/// A scene. The add_ functions fill its lists; then call finish(). After translate(), call finish()
/// again.
struct Scene {
  std::vector<Surface> surfaces;
  std::vector<Light> lights;
  Rgb background;
  View view;
  std::vector<Place> objects;  ///< where the objects are stored, in file order
  // Lists of primitives, one for each kind. finish() sorts each list in the order of the
  // hierarchy's leaves.
  std::vector<Sphere> spheres;
  std::vector<Polygon> polygons;
  std::vector<Patch> patches;
  std::vector<Cone> cones;
  std::vector<PolygonCorner> corners;  ///< corners of polygons and patches
  std::vector<Vec> normals;            ///< normals at the corners of patches
  std::vector<Texture> textures;
  std::vector<Pyramid> pyramids;  ///< pictures of the textures, as mipmaps
  /// Texture coordinates (u, v, 1) of corners, at the index of the corner in `corners`. Only
  /// polygons and patches whose texture needs coordinates have valid entries.
  std::vector<Vec> coordinates;
  /// Displacement of each object while the shutter is open; empty if no object moves. Primitives
  /// are stored as they are when the shutter opens.
  std::vector<Vec> moves;
  /// Displacement of each object and its texture by translate(); empty if there is none.
  std::vector<Vec> displacements;
  Hierarchy hierarchy;       ///< `item` of a leaf is Place::bits of its object
  double epsilon = 0;        ///< 1e-10 of the largest coordinate, see eval_epsilon()
  double least_epsilon = 0;  ///< 1e-10 of the size of the smallest object
};

/// Generous bound on the rounding error of a ray's origin, relative to the coordinates from which
/// it was computed.
inline constexpr double SELF_RELATIVE = 1e-10;

/// Smallest distance at which a ray may hit an object, if the ray starts at `origin` after a path
/// of the length `travelled` from the eye. It grows with the coordinates on this path. Very large
/// objects elsewhere have no influence.
inline double eval_epsilon(const Scene& scene, const Vec& origin, double travelled) {
  const double local = SELF_RELATIVE * std::max(max_abs(origin), travelled);
  return std::min(std::max(local, scene.least_epsilon), scene.epsilon);
}

/// Calls `f` with the Sphere, Polygon, Patch or Cone that is stored at `place`. Inlined, as the
/// intersection tests are.
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

// Functions that add an object with the surface added last. They throw BadInput for a degenerate
// shape, if the scene has no surface, for more than 2^30 objects, and if the surface's texture
// needs coordinates that a corner does not have.
void add_sphere(Scene& scene, const Vec& centre, double radius);
void add_polygon(Scene& scene, std::span<const Vec> corners,
                 std::span<const Corner> coordinates = {});
void add_patch(Scene& scene, std::span<const Vec> corners, std::span<const Vec> normals,
               std::span<const Corner> coordinates = {});
void add_cone(Scene& scene, const Vec& base, double base_radius, const Vec& apex,
              double apex_radius);

/// Moves an object by a vector. finish() must be called afterwards.
void translate(Scene& scene, std::uint32_t object, const Vec& by);

/// Computes right, above and ahead from `from`, `at` and `up`, which must be valid.
void point(View& view);
/// Returns the view with its computed fields. Throws BadInput for an impossible view.
View make_image_plane(View view);

/// Computes the image plane of the view, the hierarchy, epsilon and least_epsilon. Boxes grow by
/// 1e-12 of the largest coordinate, so that rounding never makes a ray miss the box of an object
/// that it hits. Throws BadInput if the view is impossible at any time while the shutter is open.
void finish(Scene& scene);

/// The texture coordinates at a point of an object. `point` is the position of the point when the
/// shutter opens.
TexturePoint find_texture_point(const Scene& scene, const Texture& texture, std::uint32_t object,
                                const Vec& point);

/// Displacement of a moving object when the fraction `time` of the shutter's time has passed.
/// Scene::moves must not be empty.
inline Vec eval_shift(const Scene& scene, std::uint32_t object, double time) {
  return time * scene.moves[object];
}

inline std::size_t object_count(const Scene& scene) { return scene.objects.size(); }
/// Number of boxes that are tested against rays. The leaves, which hold the objects, are not boxes.
inline std::size_t box_count(const Scene& scene) {
  return scene.hierarchy.boxes.size() - scene.objects.size();
}

}  // namespace renderer
