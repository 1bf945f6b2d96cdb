#pragma once
// Interpolation of the illumination between vertices, for each colour: bilinear, or by bicubic
// Hermite surfaces (thesis, 3.1).

#include "base/fields.hpp"
#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

enum class Reconstruction : std::uint8_t {
  flat,      ///< constant: the mean of a patch's corners
  bilinear,  ///< Gouraud interpolation
  bicubic    ///< Hermite interpolation, thesis Eq 3.1 to 3.4
};

/// How the mixed derivatives in thesis Eq 3.4 are estimated.
enum class Twist : std::uint8_t {
  zero,
  /// The slope along s + t, as in the thesis (below Eq 3.7). It is a first derivative instead of a
  /// second one, so that surfaces are C1 only on even grids of one orientation.
  diagonal,
  estimated  ///< change in direction t of the slopes along s, and vice versa
};

struct ReconstructionParams {
  Reconstruction kind = Reconstruction::bilinear;
  Twist twist = Twist::estimated;
  /// Keeps bicubic surfaces near the illumination around them (see limit.hpp).
  bool limited = true;
};

/// Makes the fields reconstruction, twist and limited.
base::Fields<ReconstructionParams> reconstruction_fields();

/// The interpolating surface over every patch: 16 values if it is bicubic, otherwise 4.
struct Illumination {
  Reconstruction kind = Reconstruction::bilinear;
  std::vector<Rgb> values;
};

/// Interpolates `vertices`, the values at all vertices of the mesh. Bicubic surfaces are continuous
/// where patches share vertices, and also where a crease has split shared vertices. If they are not
/// limited (limit.hpp), they are linear in the values, and C1 across the edges between patches on
/// grids of parallel lines. They reproduce linear functions: with estimated twists on any quads,
/// with zero twists on parallelograms. Throws BadInput for a wrong number of values.
Illumination reconstruct(const Mesh& mesh, std::span<const Rgb> vertices,
                         const ReconstructionParams& params);

/// Evaluates the bicubic surface with the matrix G_H, stored by rows, at (s, t) (thesis Eq 3.1).
Rgb eval_hermite(std::span<const Rgb, 16> g, double s, double t);

/// The illumination at the parameters (s, t) of a patch, each from 0 to 1. Never below 0.
Rgb eval_illumination(const Illumination& illumination, std::uint32_t patch, double s, double t);

}  // namespace radiosity
