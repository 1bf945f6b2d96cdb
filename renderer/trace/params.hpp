#pragma once
// Parameters of a rendering.

#include <cstdint>

#include "base/fields.hpp"
#include "renderer/trace/intersect.hpp"

namespace renderer {

/// The lights to which an intersection sends feelers.
enum class Feelers : std::uint8_t {
  all,   ///< every light, as in the thesis
  front  ///< lights on the side of the surface that the ray came from, as in the SPD
};

/// Position of a sample in its pixel.
enum class SamplePosition : std::uint8_t {
  corner,  ///< upper left corner
  center,
  lattice  ///< width x height samples span the view from edge to edge
};

/// Direction of the transmitted ray on total internal reflection in clear glass. (In rough glass it
/// is always mirrored.)
enum class TotalReflection : std::uint8_t {
  mirrored,  ///< goes into the mirror direction, so that no light is lost
  lost       ///< is omitted, as by T. Whitted (1980): the surface only reflects its ks
};

/// Limits of a shading tree.
struct Limits {
  /// Number of levels, 1..1000; the primary ray is on level 1. Limits reflected and transmitted
  /// rays, but not feelers.
  int depth = 15;
  double min_influence = 0.0;  ///< least influence factor of reflected and transmitted rays, 0..1
};

/// Number of samples in a pixel, and their distribution (R. Cook et al., 1984).
struct Sampling {
  int pixel_samples = 1;  ///< 1..MAX_PIXEL_SAMPLES; with `adaptive`, the maximum
  /// Allowed standard error of a pixel's colour after 64 samples, 0..1. After n samples, sqrt(n /
  /// 64) times this error is allowed. More samples are taken where the error is larger, and at the
  /// borders of objects. 0: all pixels get `pixel_samples`.
  double adaptive = 0;
  double lens = 1;         ///< factor on the scene's aperture, 0..MAX_LENS; 0: a pinhole
  double shutter = 1;      ///< fraction of the scene's shutter time that is used, 0..1
  std::uint64_t seed = 1;  ///< seed of all random numbers
};
inline constexpr int MAX_PIXEL_SAMPLES = 4096;

/// A rectangle of pixels, from its upper left one.
struct Area {
  int x = 0, y = 0;
  int width = 0, height = 0;  ///< size of the area; 0 x 0: the whole image
  bool operator==(const Area&) const = default;
};

struct Params {
  int width = 100, height = 100;  ///< size of the image in pixels, 1..65536 each and 2^28 together
  Limits limits;
  Sampling sampling;
  Feelers feelers = Feelers::all;
  TotalReflection total_reflection = TotalReflection::mirrored;
  SamplePosition sample = SamplePosition::corner;
  Area area;  ///< part of the image that render() computes
  Traversal traversal = Traversal::exhaustive;
  /// intensity Ia of ambient light, 0..1000 (assumed, since NFF states none)
  double ambient = 0.1;
};

/// Makes the fields width, height, depth, min_influence, feelers, total_reflection, sample,
/// traversal, ambient and area, and those of sampling_fields().
base::Fields<Params> param_fields();
/// Makes the fields pixel_samples, adaptive, lens, shutter and sample_seed.
base::Fields<Params> sampling_fields();
/// Makes the field "area", [x, y, width, height] in pixels.
base::Field<Area> area_field();

/// Throws BadInput with the field, the value found and the values expected.
void check(const Params& params);
/// `params.area`, or the whole image.
Area get_area(const Params& params);

}  // namespace renderer
