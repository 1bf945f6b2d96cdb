#pragma once
// What a rendering is asked for.

#include <cstdint>

#include "base/fields.hpp"
#include "renderer/trace/intersect.hpp"

namespace renderer {

/// Which lights get a feeler from an intersection.
enum class Feelers : std::uint8_t {
  all,   ///< every light, as in the thesis
  front  ///< lights on the side of the surface that the ray came from, as in the SPD
};

/// Where in its pixel a sample is taken.
enum class SamplePosition : std::uint8_t {
  corner,  ///< the upper left corner
  center,
  lattice  ///< width x height samples span the view from edge to edge
};

/// When a shading tree ends.
struct Limits {
  int depth = 15;  ///< levels, 1..1000: the primary ray's is 1; a reflected or transmitted
                   ///< ray is made up to this level, a feeler at every intersection
  double min_influence = 0.0;  ///< least influence factor, 0..1, with which a reflected or
                               ///< transmitted ray is made
};

/// How many samples a pixel has, and what they are distributed over (R. Cook et al., 1984).
struct Sampling {
  int pixel_samples = 1;  ///< 1..MAX_PIXEL_SAMPLES; with `adaptive`, the most
  /// Standard error of a pixel's colour, 0..1, that 64 samples may leave, n of them sqrt(n / 64)
  /// times as much: above it, and at objects' borders, more are taken; 0: all get `pixel_samples`.
  double adaptive = 0;
  double lens = 1;         ///< times the scene's aperture, 0..MAX_LENS; 0: a pinhole
  double shutter = 1;      ///< part of the scene's time that the shutter is open, 0..1
  std::uint64_t seed = 1;  ///< of all random numbers
};
inline constexpr int MAX_PIXEL_SAMPLES = 4096;

/// A rectangle of pixels; the origin is the upper left.
struct Area {
  int x = 0, y = 0;
  int width = 0, height = 0;  ///< 0 x 0: the whole image
  bool operator==(const Area&) const = default;
};

struct Params {
  int width = 100, height = 100;  ///< pixels, 1..65536 each and 2^28 together
  Limits limits;
  Sampling sampling;
  Feelers feelers = Feelers::all;
  SamplePosition sample = SamplePosition::corner;
  Area area;  ///< part of the image that render() computes
  Traversal traversal = Traversal::exhaustive;
  double ambient = 0.1;  ///< intensity of ambient light Ia, 0..1000 (assumed: NFF has none)
};

/// The fields width, height, depth, min_influence, feelers, sample, traversal, ambient and area,
/// and those of sampling_fields().
base::Fields<Params> param_fields();
/// The fields pixel_samples, adaptive, lens, shutter and sample_seed.
base::Fields<Params> sampling_fields();
/// The field "area", [x, y, width, height] in pixels.
base::Field<Area> area_field();

/// BadInput naming the field, what was found and what was expected.
void check(const Params& params);
/// `params.area`, or the whole image.
Area get_area(const Params& params);

}  // namespace renderer
