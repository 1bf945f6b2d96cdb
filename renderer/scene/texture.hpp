#pragma once
// Textures as mipmaps (L. Williams, "Pyramidal Parametrics", 1983), and their mapping onto points
// of the scene.
//
// Coordinates (u, v) of a texture: (0, 0) is the picture's lower left corner. u grows to the right
// and v upwards, both by 1 for a whole picture, which repeats. No function depends on parts of the
// maths library that differ between hosts, so that all get the same bits.

#include <cstdint>
#include <limits>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// A texel, with 0..65535 for 0 to full intensity.
struct Texel {
  std::uint16_t r = 0, g = 0, b = 0;
  bool operator==(const Texel&) const = default;
};

/// A picture at one resolution.
struct Level {
  int width = 0, height = 0;
  std::vector<Texel> texels;  ///< texels, in rows from the top
};

/// A mipmap: a picture at its own resolution, then halved along each side (rounded down, at least
/// 1) and so on to a single texel. Each texel is the mean of those that it covers.
struct Pyramid {
  std::vector<Level> levels;
};

/// Makes the mipmap of a picture with `width` x `height` pixels, each 1 or more, rows from the top,
/// 3 bytes per pixel.
Pyramid make_pyramid(int width, int height, std::span<const std::uint8_t> rgb8);

/// Number of texels of all levels together.
std::uint64_t texel_count(const Pyramid& pyramid);

/// Values above and below the picture: those of a repetition of the picture, or of its edge.
enum class Beyond : std::uint8_t { repeats, stays };

/// The colour of one level by bilinear interpolation between the middles of texels.
Rgb eval_bilinear(const Level& level, double u, double v, Beyond beyond = Beyond::repeats);

/// The colour of an area whose width is `size` texels of the first level. If `size` is at most 1,
/// it comes from the first level, else from the two levels whose texels are nearest in size.
struct Filtered {
  Rgb colour;
  int texels = 0;  ///< number of texels read
};
Filtered eval_filtered(const Pyramid& pyramid, double u, double v, double size,
                       Beyond beyond = Beyond::repeats);

/// A point of a texture, and the gradients of its coordinates in the scene.
struct TexturePoint {
  double u = 0, v = 0;
  Vec grow_u{}, grow_v{};  ///< gradients, 1 / scene unit
  Beyond beyond = Beyond::repeats;
};

/// Placement of a texture in the scene.
struct Mapping {
  enum class Kind : std::uint8_t {
    planar,     ///< along two directions, the same on all parallel planes
    spherical,  ///< by longitude and latitude around a middle
    mesh        ///< by coordinates at the corners of polygons (see Scene::coordinates)
  };
  Kind kind = Kind::mesh;
  Vec origin{};  ///< planar: position of (0, 0); spherical: the middle
  /// Planar: the gradients of u and v. Spherical: unit vectors to longitudes 0 and 90 degrees.
  Vec u{}, v{};
  Vec axis{};  ///< spherical: unit vector to the north pole
};

/// Makes a planar mapping. `along_u` and `along_v` are the lower and the left edge of the picture.
/// Throws BadInput unless they have lengths of at least 1e-20 and different directions.
Mapping make_planar(const Vec& origin, const Vec& along_u, const Vec& along_v);
/// Makes a spherical mapping. The lower edge of the picture is at the south pole, the upper edge at
/// the north pole. Seen from outside, u grows to the right. Longitude 0 is towards x, or towards y
/// if the axis is near x. Throws BadInput for an axis of length 0.
Mapping make_spherical(const Vec& middle, const Vec& axis);
inline Mapping make_mesh_mapping() { return {}; }

/// The texture point at a scene point, for planar and spherical mappings.
TexturePoint eval_mapping(const Mapping& mapping, const Vec& point);

/// A texture: a picture and its placement.
struct Texture {
  std::uint32_t pyramid = 0;  ///< picture of the texture, in Scene::pyramids
  Mapping mapping;
};

/// Value of Surface::texture for a surface without texture.
inline constexpr std::uint32_t NO_TEXTURE = std::numeric_limits<std::uint32_t>::max();

/// The angle from x to y, in turns, 0 <= a < 1; 0 if both are 0.
double eval_turn(double y, double x);

}  // namespace renderer
