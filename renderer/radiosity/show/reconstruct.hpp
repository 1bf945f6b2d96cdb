#pragma once
// Interpolation of illumination between vertices: bilinear, or by Hermite's bicubic surfaces, for
// each colour (thesis, 3.1).

#include "base/fields.hpp"
#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

enum class Reconstruction : std::uint8_t {
  flat,      ///< mean of a patch's corners
  bilinear,  ///< Gouraud interpolation
  bicubic    ///< Hermite interpolation, Eq 3.1 to 3.4
};

/// Estimator of the mixed derivatives in Eq 3.4.
enum class Twist : std::uint8_t {
  zero,
  /// The slope along s + t, as in the thesis (below Eq 3.7). It is a first derivative instead of a
  /// second one, so surfaces are C1 only on even grids of one orientation.
  diagonal,
  estimated  ///< change of the slopes along s in direction t, and vice versa
};

struct ReconstructionParams {
  Reconstruction kind = Reconstruction::bilinear;
  Twist twist = Twist::estimated;
  /// Keeps bicubic surfaces near the illumination around them (limit.hpp).
  bool limited = true;
};

/// Makes the fields reconstruction, twist and limited.
base::Fields<ReconstructionParams> reconstruction_fields();

/// The surface over every patch: 16 values if bicubic, else 4.
struct Illumination {
  Reconstruction kind = Reconstruction::bilinear;
  std::vector<Rgb> values;
};

/// Interpolates `vertices`, one value for each vertex of the mesh. Bicubic surfaces are continuous
/// where patches share vertices, and also where a crease has split shared vertices. If they are not
/// limited (limit.hpp), they are linear in the values, and on grids of parallel lines C1 across the
/// edges between patches. They reproduce linear functions: with estimated twists on any quads, with
/// zero twists on parallelograms. Throws BadInput for a wrong number of values.
Illumination reconstruct(const Mesh& mesh, std::span<const Rgb> vertices,
                         const ReconstructionParams& params);

/// The bicubic surface of G_H, given by rows, at (s, t) (Eq 3.1).
Rgb eval_hermite(std::span<const Rgb, 16> g, double s, double t);

/// The illumination at (s, t) of a patch, each 0..1; never below 0.
Rgb eval_illumination(const Illumination& illumination, std::uint32_t patch, double s, double t);

}  // namespace radiosity
