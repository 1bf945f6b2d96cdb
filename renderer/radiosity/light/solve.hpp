#pragma once
// Progressive radiosity (M. Cohen et al., SIGGRAPH 1988; thesis, 1.2.2.2). In each step, a shot,
// the patch with the most unsent light sends it to every vertex of the mesh. rows.hpp caches form
// factors between shots.

#include <functional>

#include "renderer/radiosity/light/balance.hpp"
#include "renderer/radiosity/light/form_factor.hpp"

namespace radiosity {

/// A shot: the light that one patch sends to all vertices.
struct Shot {
  std::uint32_t patch = 0;
  Glow glow;         ///< unsent radiosity of the patch
  double power = 0;  ///< sum of `glow` over the colours, multiplied by the patch's area
};

/// The distribution over a patch of the light that it sends.
enum class Sends : std::uint8_t {
  mean,     ///< constant, as in J. Wallace's paper and the thesis; dark parts send too much
  corners,  ///< bilinear, as received by the corners of the patch
};

/// The light of all vertices and patches during a solution. In a parallel run, the owner of a patch
/// updates the light of the patch and of its vertices.
struct State {
  std::vector<Rgb> radiosity;  ///< radiosity of each vertex
  std::vector<Rgb> unshot;     ///< mean unsent radiosity of each patch
  /// Area of each patch, copied from the mesh. Every shot reads all areas; contiguous reads are
  /// faster.
  std::vector<double> areas;
  /// Unsent radiosity at the corners of each patch; empty for Sends::mean.
  std::vector<std::array<Rgb, 4>> in_corners;
  std::vector<Rgb> received;   ///< light that each vertex received in the last shot
  std::vector<Rgb> in_centre;  ///< light that each patch's centre received in the last shot
  /// Light received by each patch: mean over its area, sum over all shots.
  std::vector<Rgb> arrived;
};

/// Makes the initial state, in which all emitted light is unsent.
State make_state(const Mesh& mesh, Sends sends);

/// Returns the shot of the patch in `patches` with the most unsent power. If several have equal
/// power, the first of them shoots. Returns none if no patch has unsent power.
std::optional<Shot> find_shot(const Mesh& mesh, const State& state,
                              std::span<const std::uint32_t> patches, renderer::Work& work);

/// Computes the light that the given vertices receive from the sender, and adds the light that they
/// reflect to their radiosity (thesis Eq 3.9 and 3.17). The sender may belong to another mesh of
/// the room.
void receive(const Eye& eye, const Sender& sender, std::span<const std::uint32_t> vertices,
             State& state, renderer::Work& work);

/// Computes the light that the centres of the given patches receive. Needed for Mean::simpson.
void receive_in_centres(const Eye& eye, const Sender& sender,
                        std::span<const std::uint32_t> patches, State& state, renderer::Work& work);

/// How the mean light that a patch receives is estimated.
enum class Mean : std::uint8_t {
  /// Mean of the corners, as in J. Wallace's paper and the thesis; exact for bilinear light.
  corners,
  simpson,  ///< 1/12 of each corner plus 2/3 of the centre; exact for cubic light
};

/// Ends a shot: adds the reflected part of the mean received light to the unsent light of the given
/// patches. Clears the unsent light of the patch that sent it. The corners and centres of the
/// patches must have received the shot before.
void settle(const Mesh& mesh, const Shot& shot, std::span<const std::uint32_t> patches, Mean mean,
            State& state, renderer::Work& work);

/// Unsent power in fixed point. A sum of such numbers does not depend on the order.
struct Unshot {
  static constexpr double ONE = 1LL << 40;  ///< number of units in the power that the room emits
  std::int64_t r = 0, g = 0, b = 0;
  Unshot& operator+=(const Unshot& other);
  bool operator==(const Unshot&) const = default;
};
Unshot sum_unshot(const Mesh& mesh, const State& state, std::span<const std::uint32_t> patches);
/// The unsent power as a fraction of the emitted power; 1 at the start.
double eval_share(const Unshot& unshot);

/// The ambient term of Cohen et al.: the radiosity that results if the unsent power spreads evenly
/// over the room and is reflected repeatedly, with the room's mean reflectance.
Rgb eval_ambient(const Mesh& mesh, const Unshot& unshot);
/// Adds the ambient light to each vertex, multiplied by the vertex's reflectance.
void add_ambient(const Mesh& mesh, const Rgb& ambient, std::vector<Rgb>& vertices);

struct SolveParams {
  FactorParams factor;
  Mean mean = Mean::simpson;
  Sends sends = Sends::corners;
  int shots = 1'000'000;  ///< limit on the number of shots, >= 0
  /// The solution ends when the unsent power is at most this fraction of the emitted power, 0..1.
  double tolerance = 0.001;
};

struct Solution {
  std::vector<Rgb> vertices;  ///< radiosity of each vertex, without ambient light
  /// Mean radiosity of each patch of the mesh that sent the light, without ambient light.
  std::vector<Rgb> means;
  Rgb ambient;  ///< ambient light (see eval_ambient)
  int shots = 0;
  double unshot = 0;  ///< unsent power as a fraction of the emitted power
  Balance balance;    ///< energy balance of the mesh that sent the light
  renderer::Work work;
  State state;  ///< final state of the mesh that sent the light, for solve_further()
};

/// Makes the fields of FactorParams, and the fields mean, sends, max_shots and tolerance.
base::Fields<SolveParams> solve_fields();

/// A function that is called after every shot with the number of shots and the unsent fraction of
/// the power. It ends the solution by returning false.
using Step = std::function<bool(int shots, double unshot)>;

/// Repeats shots until the tolerance or the number of shots is reached, or until `step`, if given,
/// returns false. `fine`, if given, is another mesh of the room. Its vertices receive every shot
/// too, and become the vertices of the solution. The number of shots then depends only on the
/// coarse `mesh`; a `mesh` of 14,000 patches would need a hundred times as many shots.
/// (Substructuring: M. Cohen, D. Greenberg, D. Immel and P. Brock, "An Efficient Radiosity Approach
/// for Realistic Image Synthesis", IEEE CG&A 6(3), 1986.)
Solution solve(const Mesh& mesh, const SolveParams& params, const Step& step = {},
               const Mesh* fine = nullptr);

/// Continues a solution of the same mesh as if it had not been interrupted. `sends` must be
/// unchanged.
Solution solve_further(const Mesh& mesh, const SolveParams& params, Solution begun,
                       const Step& step = {});

/// The centre of a patch, as a vertex that can receive light.
Vertex make_centre(const Patch& patch);

/// The indices of all vertices, or of all patches, of a mesh.
std::vector<std::uint32_t> all_vertices(const Mesh& mesh);
std::vector<std::uint32_t> all_patches(const Mesh& mesh);

/// The mesh of a room with its computed light.
struct LitRoom {
  Mesh mesh;
  std::vector<Rgb> vertices;  ///< radiosity of each vertex of the mesh
};

struct LightParams {
  MeshParams mesh;
  /// MeshParams::refine, 1 to 1000, of a separate mesh whose patches send the light. It should be
  /// coarser than the mesh that receives the light. With 0, the patches of the receiving mesh send.
  int senders = 0;
  SolveParams solve;
  bool ambient = true;  ///< adds eval_ambient(), an estimate of the light from unsent power
};

/// Makes the field `senders` of LightParams.
base::Field<LightParams> senders_field();

/// Computes the light at the vertices of `mesh`, which is a mesh of the room. Either its own
/// patches send the light, or those of a separate mesh (params.senders). Throws BadInput as
/// make_mesh() and solve() do.
Solution solve_room(const Room& room, const Mesh& mesh, const LightParams& params,
                    const Step& step = {});

/// Makes a mesh of the room and computes its light. The room must pass check(). Throws BadInput as
/// make_mesh() and solve() do.
LitRoom light_room(const Room& room, const LightParams& params);

/// The mean radiosity of the mesh's patches, weighted by area and averaged over the three colours.
/// Counts only patches whose materials also occur in `other`.
double eval_mean_radiosity(const LitRoom& lit, const Mesh& other);

}  // namespace radiosity
