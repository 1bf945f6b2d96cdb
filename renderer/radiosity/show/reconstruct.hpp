#pragma once
// Illumination between vertices: bilinear, or by Hermite's bicubic surfaces, one for each colour
// (thesis, 3.1).

#include "base/fields.hpp"
#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

enum class Reconstruction : std::uint8_t {
  flat,      ///< the mean of a patch's corners
  bilinear,  ///< Gouraud's
  bicubic    ///< Hermite's, Eq 3.1 to 3.4
};

/// The mixed derivatives of Eq 3.4.
enum class Twist : std::uint8_t {
  zero,
  diagonal,  ///< the slope along s + t, as the thesis says (below Eq 3.7): a first derivative in
             ///< place of a second, C1 on even grids of one orientation only
  estimated  ///< how the slopes along s change along t and the other way round
};

struct ReconstructionParams {
  Reconstruction kind = Reconstruction::bilinear;
  Twist twist = Twist::estimated;
  /// Whether bicubic surfaces stay near the illumination around them (limit.hpp).
  bool limited = true;
};

/// The fields reconstruction, twist and limited.
base::Fields<ReconstructionParams> reconstruction_fields();

/// The surface over every patch: 16 values if bicubic, else 4.
struct Illumination {
  Reconstruction kind = Reconstruction::bilinear;
  std::vector<Rgb> values;
};

/// `vertices`: a value for each of the mesh's vertices. Bicubic surfaces are continuous wherever
/// patches share vertices or a crease has split these; where none is limited (limit.hpp), they are
/// linear in the values, and C1 across inner borders on grids of parallel lines. Linear functions
/// stay so: with estimated twists on any quads, with none on parallelograms. BadInput if there are
/// more or fewer values than vertices.
Illumination reconstruct(const Mesh& mesh, std::span<const Rgb> vertices,
                         const ReconstructionParams& params);

/// The bicubic surface of G_H, given by rows, at (s, t): Eq 3.1.
Rgb eval_hermite(std::span<const Rgb, 16> g, double s, double t);

/// The illumination at (s, t) of a patch, each 0..1; never below 0.
Rgb eval_illumination(const Illumination& illumination, std::uint32_t patch, double s, double t);

}  // namespace radiosity
