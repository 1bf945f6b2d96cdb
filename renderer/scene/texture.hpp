#pragma once
// Textures as mipmaps (L. Williams, "Pyramidal Parametrics", 1983), and their placement in the
// scene.
//
// Coordinates (u, v) of a texture: (0, 0) is the lower left corner of the picture. u grows to the
// right and v upwards, both by 1 for a whole picture; the picture repeats. No function uses those
// parts of the maths library that differ between hosts, so that all hosts get the same bits.

#include <cstdint>
#include <limits>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// A texel: a pixel of a texture. 0..65535 stands for 0 to full intensity.
struct Texel {
  std::uint16_t r = 0, g = 0, b = 0;
  bool operator==(const Texel&) const = default;
};

/// A picture at one resolution.
struct Level {
  int width = 0, height = 0;
  std::vector<Texel> texels;  ///< rows from the top
};

/// A mipmap. The first level is the picture at its own resolution. Each further level has half as
/// many texels along each side (rounded down, at least 1), down to a single texel. A texel is the
/// mean of the texels that it covers.
struct Pyramid {
  std::vector<Level> levels;
};

/// Makes the mipmap of a picture with `width` x `height` pixels, each at least 1. `rgb8` has rows
/// from the top, 3 bytes per pixel.
Pyramid make_pyramid(int width, int height, std::span<const std::uint8_t> rgb8);

/// Number of texels in all levels together.
std::uint64_t texel_count(const Pyramid& pyramid);

/// What is above and below the picture: the repeated picture, or the colours of the picture's edge.
enum class Beyond : std::uint8_t { repeats, stays };

/// The colour of one level at (u, v), by bilinear interpolation between the centres of texels.
Rgb eval_bilinear(const Level& level, double u, double v, Beyond beyond = Beyond::repeats);

/// The mean colour of an area whose width is `size` texels of the first level. For a `size` of at
/// most 1, it comes from the first level; otherwise, from the two levels whose texels are nearest
/// in size.
struct Filtered {
  Rgb colour;
  int texels = 0;  ///< number of texels read
};
Filtered eval_filtered(const Pyramid& pyramid, double u, double v, double size,
                       Beyond beyond = Beyond::repeats);

/// A point of a texture: its coordinates (u, v), and the gradients of these coordinates in the
/// scene.
struct TexturePoint {
  double u = 0, v = 0;
  Vec grow_u{}, grow_v{};  ///< gradients of u and v, per scene unit
  Beyond beyond = Beyond::repeats;
};

/// How a texture is placed in the scene.
struct Mapping {
  enum class Kind : std::uint8_t {
    planar,     ///< by projection along a direction: the same on all parallel planes
    spherical,  ///< by longitude and latitude around a centre
    mesh        ///< by texture coordinates at the corners of polygons (Scene::coordinates)
  };
  Kind kind = Kind::mesh;
  Vec origin{};  ///< planar: position of (u, v) = (0, 0); spherical: the centre
  /// Planar: gradients of u and v. Spherical: unit vectors towards longitudes 0 and 90 degrees.
  Vec u{}, v{};
  Vec axis{};  ///< spherical: unit vector towards the north pole
};

/// Makes a planar mapping. `along_u` and `along_v` are the lower and the left edge of the picture.
/// Throws BadInput unless both have a length of at least 1e-20 and their directions differ.
Mapping make_planar(const Vec& origin, const Vec& along_u, const Vec& along_v);
/// Makes a spherical mapping. The lower edge of the picture is at the south pole, and the upper
/// edge at the north pole. Seen from outside, u grows to the right. Longitude 0 is towards x, or
/// towards y if the axis is near x. Throws BadInput for an axis of length 0.
Mapping make_spherical(const Vec& middle, const Vec& axis);
inline Mapping make_mesh_mapping() { return {}; }

/// The texture point at a point of the scene, for planar and spherical mappings.
TexturePoint eval_mapping(const Mapping& mapping, const Vec& point);

/// A texture: a picture and its placement.
struct Texture {
  std::uint32_t pyramid = 0;  ///< index of the picture in Scene::pyramids
  Mapping mapping;
};

/// Value of Surface::texture for a surface without texture.
inline constexpr std::uint32_t NO_TEXTURE = std::numeric_limits<std::uint32_t>::max();

/// The angle of the vector (x, y) from the x axis, in turns: 0 <= angle < 1; 0 if both are 0.
double eval_turn(double y, double x);

}  // namespace renderer
