#pragma once
// Pictures on surfaces: a picture in levels of falling resolution (L. Williams, "Pyramidal
// Parametrics", 1983), and which of its points a point of the scene shows.
//
// Coordinates (u, v) of a texture: (0, 0) is the picture's lower left corner, u grows to the right
// and v upwards, both by 1 for a whole picture, which repeats itself. No function uses the
// mathematics library where it differs between machines: the same bits on any.

#include <cstdint>
#include <limits>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// A picture's point: 0..65535 is 0 to full intensity.
struct Texel {
  std::uint16_t r = 0, g = 0, b = 0;
  bool operator==(const Texel&) const = default;
};

/// A picture at one resolution.
struct Level {
  int width = 0, height = 0;
  std::vector<Texel> texels;  ///< rows from the top
};

/// A picture at its own resolution, then at half of it along each side (rounded down, 1 or more)
/// and so on to a single texel, each the mean of what it covers.
struct Pyramid {
  std::vector<Level> levels;
};

/// Of rows from the top, 3 bytes a pixel, of which there are `width` x `height`, 1 or more.
Pyramid make_pyramid(int width, int height, std::span<const std::uint8_t> rgb8);

/// All levels together.
std::uint64_t texel_count(const Pyramid& pyramid);

/// Above and below the picture: it again, or its edge.
enum class Beyond : std::uint8_t { repeats, stays };

/// The colour of one level, bilinear between the middles of texels.
Rgb eval_bilinear(const Level& level, double u, double v, Beyond beyond = Beyond::repeats);

/// The same of a point of the picture that is `size` texels (of the first level) wide: up to 1, of
/// the first level; else between the two levels whose texels are nearest to it in size.
struct Filtered {
  Rgb colour;
  int texels = 0;  ///< that were read
};
Filtered eval_filtered(const Pyramid& pyramid, double u, double v, double size,
                       Beyond beyond = Beyond::repeats);

/// A point of a texture, and how its coordinates grow with the scene's.
struct TexturePoint {
  double u = 0, v = 0;
  Vec grow_u{}, grow_v{};  ///< gradients, 1 / scene unit
  Beyond beyond = Beyond::repeats;
};

/// How a texture lies in the scene.
struct Mapping {
  enum class Kind : std::uint8_t {
    planar,     ///< along two directions, the same on all parallel planes
    spherical,  ///< by longitude and latitude around a middle
    mesh        ///< by coordinates at the corners of polygons, see Scene::coordinates
  };
  Kind kind = Kind::mesh;
  Vec origin{};  ///< planar: of (0, 0); spherical: the middle
  /// Planar: the gradients of u and v. Spherical: unit vectors to longitudes 0 and 90 degrees.
  Vec u{}, v{};
  Vec axis{};  ///< spherical: unit, to the north pole
};

/// `along_u` and `along_v` are the lower and the left edge of one picture. BadInput unless they
/// have lengths (1e-20 or more) and different directions.
Mapping make_planar(const Vec& origin, const Vec& along_u, const Vec& along_v);
/// The lower edge of the picture is the south pole, the upper one the north pole; from outside, u
/// grows to the right. Longitude 0 is towards x, or towards y where the axis is nearer to x.
/// BadInput for an axis of length 0.
Mapping make_spherical(const Vec& middle, const Vec& axis);
inline Mapping make_mesh_mapping() { return {}; }

/// The texture's point of a mapping that is not a mesh's.
TexturePoint eval_mapping(const Mapping& mapping, const Vec& point);

/// A picture on surfaces.
struct Texture {
  std::uint32_t pyramid = 0;  ///< index in Scene::pyramids
  Mapping mapping;
};

/// The texture of a surface without one.
inline constexpr std::uint32_t NO_TEXTURE = std::numeric_limits<std::uint32_t>::max();

/// The angle from x to y, as a share of a whole turn, 0 <= a < 1; 0 for both 0.
double eval_turn(double y, double x);

}  // namespace renderer
