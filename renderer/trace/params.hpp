#pragma once
// Parameters of a rendering.

#include <cstdint>

#include "base/fields.hpp"
#include "renderer/trace/intersect.hpp"

namespace renderer {

/// The lights to which rays (shadow feelers) are cast from a hit.
enum class Feelers : std::uint8_t {
  all,   ///< every light, as in the thesis
  front  ///< lights on the side of the surface from which the ray came, as in the SPD
};

/// Position of a sample in its pixel.
enum class SamplePosition : std::uint8_t {
  corner,  ///< upper left corner of the pixel
  center,
  lattice  ///< the width x height samples span the view from edge to edge
};

/// What happens to the transmitted ray on total internal reflection in clear glass. (In rough glass
/// it is always mirrored.)
enum class TotalReflection : std::uint8_t {
  mirrored,  ///< goes in the mirror direction, so that no light is lost
  lost       ///< is omitted, as in T. Whitted's paper (1980): the surface reflects only ks
};

/// Limits of a shading tree.
struct Limits {
  /// Number of levels, 1..1000. The ray from the eye is on level 1. Limits reflected and
  /// transmitted rays, but not shadow feelers.
  int depth = 15;
  /// Smallest influence factor of reflected and transmitted rays, 0..1.
  double min_influence = 0.0;
};

/// Number of samples in a pixel, and their distribution (R. Cook et al., 1984).
struct Sampling {
  int pixel_samples = 1;  ///< 1..MAX_PIXEL_SAMPLES; if `adaptive` is not 0, the largest number
  /// Standard error of a pixel's colour that is allowed after 64 samples, 0..1. After n samples,
  /// sqrt(n / 64) times this error is allowed. More samples are taken where the error is larger,
  /// and at the borders of objects. 0: all pixels get `pixel_samples`.
  double adaptive = 0;
  double lens = 1;     ///< factor on the aperture of the scene's lens, 0..MAX_LENS; 0: a pinhole
  double shutter = 1;  ///< fraction of the scene's shutter time that is used, 0..1
  std::uint64_t seed = 1;  ///< seed of all random numbers
};
inline constexpr int MAX_PIXEL_SAMPLES = 4096;

/// A rectangle of pixels. (x, y) is its upper left pixel.
struct Area {
  int x = 0, y = 0;
  int width = 0, height = 0;  ///< 0 x 0 stands for the whole image
  bool operator==(const Area&) const = default;
};

struct Params {
  /// Size of the image in pixels, 1..65536 each, product at most 2^28
  int width = 100, height = 100;
  Limits limits;
  Sampling sampling;
  Feelers feelers = Feelers::all;
  TotalReflection total_reflection = TotalReflection::mirrored;
  SamplePosition sample = SamplePosition::corner;
  Area area;  ///< part of the image that render() computes
  Traversal traversal = Traversal::exhaustive;
  /// Intensity Ia of ambient light, 0..1000. The default is an assumption, because NFF has no such
  /// value.
  double ambient = 0.1;
};

/// Makes the fields width, height, depth, min_influence, feelers, total_reflection, sample,
/// traversal, ambient and area, and those of sampling_fields().
base::Fields<Params> param_fields();
/// Makes the fields pixel_samples, adaptive, lens, shutter and sample_seed.
base::Fields<Params> sampling_fields();
/// Makes the field "area", [x, y, width, height] in pixels.
base::Field<Area> area_field();

/// Throws BadInput with the name of the field, the value found and the values expected.
void check(const Params& params);
/// Returns `params.area`, or the whole image if this area is 0 x 0.
Area get_area(const Params& params);

}  // namespace renderer
