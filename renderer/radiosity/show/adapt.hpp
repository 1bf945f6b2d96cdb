#pragma once
// Adaptive meshes, with small patches where the illumination varies. The error estimate of a patch
// is the difference at its centre between the light computed there (for Mean::simpson) and the
// interpolated surface.

#include "renderer/radiosity/light/solve.hpp"
#include "renderer/radiosity/show/reconstruct.hpp"

namespace radiosity {

struct AdaptParams {
  double error = 0;  ///< target of adapt_mesh(), LEAST_ERROR..1; with 0, the mesh is not adapted
};
inline constexpr double LEAST_ERROR = 1e-4;

/// Makes the field "adaptive".
base::Field<AdaptParams> adaptive_field();

struct AdaptedMesh {
  Mesh mesh;
  int rounds = 0;    ///< number of rounds in which patches were halved
  double error = 0;  ///< estimated error that remains, in the unit of AdaptParams::error
  Solution rough;    ///< preliminary solution, which solve_further() can continue
};

/// Halves patches, starting from those of params.mesh, until the estimated error of the picture in
/// the room's view is at most `adapt.error`. The error is the root mean square of the estimates,
/// divided by the root mean square of the picture's light without emission. Only the interpolation
/// error is estimated, not the error at the vertices.
///
/// Each round halves the patches with the largest errors (W. Doerfler, "A Convergent Adaptive
/// Algorithm for Poisson's Equation", SIAM J. Numerical Analysis 33(3), 1996). Only visible patches
/// count (B. Smits, J. Arvo, D. Salesin, "An Importance-Driven Radiosity Algorithm", SIGGRAPH
/// 1992). Whole rows of a face are halved, so that patches meet at their corners; a face without 4
/// corners is refined everywhere. Curved faces are assumed to have no error. The rounds also end
/// after MOST_ROUNDS, and before the number of patches would exceed MOST_ADAPTED.
///
/// Calls `step` during all solutions (see solve()). Throws BadInput for an error below LEAST_ERROR,
/// for a params.solve.mean other than Mean::simpson, and as find_shares() does.
AdaptedMesh adapt_mesh(Room room, const LightParams& params,
                       const ReconstructionParams& reconstruction, const AdaptParams& adapt,
                       const Step& step = {});
/// Computes the light of a mesh from adapt_mesh() or make_lit_mesh(). Continues the solution
/// `rough` if there is one and the mesh's own patches send the light. Otherwise solves as
/// solve_room() does.
Solution solve_adapted(const Room& room, AdaptedMesh& adapted, const LightParams& params,
                       const Step& step = {});

/// Makes the mesh of a room. With Room::fine_near_lights, rows of patches are halved, up to twice,
/// if the computed light at a patch's middle differs from the interpolated surface by more than
/// MOST_OFF_HERE. They are halved in the direction in which the light of the patch's corners
/// differs more, for example across a slit or a bright strip. The view does not matter. The mesh
/// has at most twice as many patches as make_graded() makes. `rough` is a solution that
/// solve_adapted() continues. With LightParams::senders or Mean::corners, the patches are those of
/// make_mesh(). Faces without 4 corners are not halved.
AdaptedMesh make_lit_mesh(const Room& room, const LightParams& params, const Step& step = {});
inline constexpr double MOST_OFF_HERE = 0.15;

/// Estimates the interpolation error of the picture in `view`: its root mean square, divided by the
/// root mean square of the picture's light without emission. Returns 0 unless params.mean is
/// Mean::simpson. `solution` must be the solution of the mesh that sent the light.
double estimate_error(const Mesh& mesh, const Solution& solution, const SolveParams& params,
                      const ReconstructionParams& reconstruction, const renderer::View& view);

inline constexpr int MOST_ROUNDS = 40;
inline constexpr std::size_t MOST_ADAPTED = 200'000;

}  // namespace radiosity
