#pragma once
// A room cut into patches that are small where the illumination varies. What a patch's centre has
// received, which Mean::simpson needs, tells how far the surface over the patch is off there.

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
  double error = 0;  ///< the estimate of what is left, as `error` above
  Solution rough;    ///< the mesh's light, from which solve_further() goes on
};

/// Halves patches, beginning with those of params.mesh, until the error of the picture that the
/// room's view shows, root mean square over that of its light without what emits, is estimated to
/// be at most `adapt.error`: each time those that make most of it (W. Doerfler, "A Convergent
/// Adaptive Algorithm for Poisson's Equation", SIAM J. Numerical Analysis 33(3), 1996), so that
/// what is not seen stays as it is (B. Smits, J. Arvo, D. Salesin, "An Importance-Driven Radiosity
/// Algorithm", SIGGRAPH 1992). Estimated is what surfaces are off between vertices, not what these
/// have received. Whole rows of a face's patches are halved, so that its patches meet at their
/// corners; a face of other than 4 corners is refined everywhere. Curved faces are not judged. Ends
/// as well after MOST_ROUNDS, or where the room would have more than MOST_ADAPTED patches. `step`
/// is called in all solutions, see solve(). BadInput below LEAST_ERROR, and unless
/// params.solve.mean is Mean::simpson; throws as find_shares().
AdaptedMesh adapt_mesh(Room room, const LightParams& params,
                       const ReconstructionParams& reconstruction, const AdaptParams& adapt,
                       const Step& step = {});
/// The light of what adapt_mesh() made of the room: goes on from `rough`, or see solve_room().
Solution solve_adapted(const Room& room, AdaptedMesh& adapted, const LightParams& params,
                       const Step& step = {});

/// The mesh of a room: make_mesh()'s, but if Room::fine_near_lights, rows of patches are halved
/// twice at most in whose middles the light is off the surface by more than MOST_OFF_HERE of it,
/// in the direction in which the light of their corners differs. That is so where light is
/// concentrated, as behind a slit or beside a bright strip. The view does not matter. `rough` is a
/// solution from which solve_adapted() goes on. Patches become twice as many as make_graded()'s at
/// most. Params::senders, Mean::corners and faces of other than 4 corners are left alone.
AdaptedMesh make_lit_mesh(const Room& room, const LightParams& params, const Step& step = {});
inline constexpr double MOST_OFF_HERE = 0.15;

/// The estimate of how far the picture that the view shows is off between vertices, root mean
/// square over that of its light without what emits; 0 where means are not Simpson's. `solution`
/// must be of the mesh that sends.
double estimate_error(const Mesh& mesh, const Solution& solution, const SolveParams& params,
                      const ReconstructionParams& reconstruction, const renderer::View& view);

inline constexpr int MOST_ROUNDS = 40;
inline constexpr std::size_t MOST_ADAPTED = 200'000;

}  // namespace radiosity
