#pragma once
// Meshes with small patches where the illumination varies. The error estimate of a patch is the
// difference between the light found at its centre (for Mean::simpson) and the surface there.

#include "renderer/radiosity/light/solve.hpp"
#include "renderer/radiosity/show/reconstruct.hpp"

namespace radiosity {

struct AdaptParams {
  double error = 0;  ///< see adapt_mesh(); LEAST_ERROR..1, or 0: patches as they are
};
inline constexpr double LEAST_ERROR = 1e-4;

/// The field "adaptive".
base::Field<AdaptParams> adaptive_field();

struct AdaptedMesh {
  Mesh mesh;
  int rounds = 0;    ///< how often patches were halved
  double error = 0;  ///< estimate of the remaining error, as AdaptParams::error
  Solution rough;    ///< rough solution that solve_further() continues
};

/// Halves patches, starting from those of params.mesh, until the estimated error of the picture in
/// the room's view is at most `adapt.error`. The error is a root mean square relative to that of
/// the picture's light, without emission. Each round halves the patches with the largest part of
/// the error (W. Doerfler, "A Convergent Adaptive Algorithm for Poisson's Equation", SIAM J.
/// Numerical Analysis 33(3), 1996), and only visible ones count (B. Smits, J. Arvo, D. Salesin, "An
/// Importance-Driven Radiosity Algorithm", SIGGRAPH 1992). It estimates the interpolation error
/// only, not the error at the vertices. Whole rows of a face are halved, so that patches meet at
/// their corners; a face without 4 corners is refined everywhere. Curved faces are not judged. Ends
/// after MOST_ROUNDS too, or before the room would exceed MOST_ADAPTED patches. Calls `step` in all
/// solutions, see solve(). BadInput below LEAST_ERROR, and unless params.solve.mean is
/// Mean::simpson; throws as find_shares().
AdaptedMesh adapt_mesh(Room room, const LightParams& params,
                       const ReconstructionParams& reconstruction, const AdaptParams& adapt,
                       const Step& step = {});
/// The light of a mesh from adapt_mesh() or make_lit_mesh(): continues `rough`, or see
/// solve_room().
Solution solve_adapted(const Room& room, AdaptedMesh& adapted, const LightParams& params,
                       const Step& step = {});

/// The mesh of a room. If Room::fine_near_lights, rows of patches are halved, at most twice, if the
/// light in a patch's middle is more than MOST_OFF_HERE off the surface. They are halved in the
/// direction in which the light of the corners differs, for example behind a slit or beside a
/// bright strip, in any view. `rough` is a solution that solve_adapted() continues. The mesh has at
/// most twice the patches of make_graded()'s. Params::senders, Mean::corners and faces without 4
/// corners give make_mesh()'s patches.
AdaptedMesh make_lit_mesh(const Room& room, const LightParams& params, const Step& step = {});
inline constexpr double MOST_OFF_HERE = 0.15;

/// Estimates the interpolation error of the picture in `view`, as a root mean square relative to
/// that of its light without emission; 0 unless means are Simpson's. `solution` must be of the mesh
/// that sends.
double estimate_error(const Mesh& mesh, const Solution& solution, const SolveParams& params,
                      const ReconstructionParams& reconstruction, const renderer::View& view);

inline constexpr int MOST_ROUNDS = 40;
inline constexpr std::size_t MOST_ADAPTED = 200'000;

}  // namespace radiosity
