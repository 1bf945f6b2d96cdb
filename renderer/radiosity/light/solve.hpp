#pragma once
// Progressive refinement: the patch with most unsent light sends it to every vertex, then the next
// one (thesis, 1.2.2.2; M. Cohen et al., SIGGRAPH 1988). rows.hpp keeps form factors.

#include <functional>

#include "renderer/radiosity/light/balance.hpp"
#include "renderer/radiosity/light/form_factor.hpp"

namespace radiosity {

/// A patch's light, sent to all vertices.
struct Shot {
  std::uint32_t patch = 0;
  Glow glow;         ///< the patch's unsent radiosity
  double power = 0;  ///< sum of `glow` over the colours, times the patch's area
};

/// Distribution of a patch's unsent light over its area.
enum class Sends : std::uint8_t {
  mean,     ///< even, by J. Wallace and the thesis: dark edges and corners send too much
  corners,  ///< bilinear, as received by its corners
};

/// The light of all vertices and patches. In a parallel run, the owner of a patch updates its light
/// and that of its vertices.
struct State {
  std::vector<Rgb> radiosity;  ///< by vertex
  std::vector<Rgb> unshot;     ///< by patch, the mean
  /// By patch, copied from the mesh: every shot reads them all, and contiguous reads are faster.
  std::vector<double> areas;
  /// By patch, the unsent light at its corners; none for Sends::mean.
  std::vector<std::array<Rgb, 4>> in_corners;
  std::vector<Rgb> received;   ///< by vertex, received in the last shot
  std::vector<Rgb> in_centre;  ///< by patch, received at its centre in the last shot
  std::vector<Rgb> arrived;    ///< by patch, the mean received in all shots
};

/// Initial state: all emission is unsent.
State make_state(const Mesh& mesh, Sends sends);

/// A shot of the patch with most unsent power among `patches`, the first of equals; none if dark.
std::optional<Shot> find_shot(const Mesh& mesh, const State& state,
                              std::span<const std::uint32_t> patches, renderer::Work& work);

/// Adds the reflected share of a sent radiosity to the given vertices: Eq 3.9 and 3.17. The patch
/// may belong to another mesh of the same room.
void receive(const Eye& eye, const Sender& sender, std::span<const std::uint32_t> vertices,
             State& state, renderer::Work& work);

/// Computes the light at the centres of the given patches, for Mean::simpson.
void receive_in_centres(const Eye& eye, const Sender& sender,
                        std::span<const std::uint32_t> patches, State& state, renderer::Work& work);

/// Estimate of a patch's received light from points on it.
enum class Mean : std::uint8_t {
  corners,  ///< mean of the corners: exact for bilinear light; by J. Wallace and the thesis
  simpson,  ///< 1/12 of each corner and 2/3 of the centre: exact for cubic light
};

/// Adds the reflected mean of the received light to the unsent light of the given patches, and
/// clears that of the shot's patch. The patches' corners, and centres, must have received the shot.
void settle(const Mesh& mesh, const Shot& shot, std::span<const std::uint32_t> patches, Mean mean,
            State& state, renderer::Work& work);

/// Unsent power in fixed point, so that a sum does not depend on its order.
struct Unshot {
  static constexpr double ONE = 1LL << 40;  ///< units in the power that the room emits
  std::int64_t r = 0, g = 0, b = 0;
  Unshot& operator+=(const Unshot& other);
  bool operator==(const Unshot&) const = default;
};
Unshot sum_unshot(const Mesh& mesh, const State& state, std::span<const std::uint32_t> patches);
/// The unsent fraction of the emitted power: 1 at first.
double eval_share(const Unshot& unshot);

/// Cohen's estimate of the light from the unsent power, if it spreads evenly and is reflected
/// repeatedly with the room's mean reflectance.
Rgb eval_ambient(const Mesh& mesh, const Unshot& unshot);
/// Adds to each vertex the ambient light times its reflectance.
void add_ambient(const Mesh& mesh, const Rgb& ambient, std::vector<Rgb>& vertices);

struct SolveParams {
  FactorParams factor;
  Mean mean = Mean::simpson;
  Sends sends = Sends::corners;
  int shots = 1'000'000;     ///< maximum number of shots, >= 0
  double tolerance = 0.001;  ///< unsent fraction of the emitted power at which it ends, 0..1
};

struct Solution {
  std::vector<Rgb> vertices;  ///< radiosity, by vertex, without ambient
  std::vector<Rgb> means;     ///< of the sending mesh: mean radiosity by patch, without ambient
  Rgb ambient;                ///< see eval_ambient
  int shots = 0;
  double unshot = 0;  ///< fraction of the emitted power
  Balance balance;    ///< of the sending mesh
  renderer::Work work;
  State state;  ///< of the sending mesh, for solve_further()
};

/// The fields of the form factors, mean, sends, max_shots and tolerance.
base::Fields<SolveParams> solve_fields();

/// Called after every shot with the number of shots and the unsent fraction; false ends it.
using Step = std::function<bool(int shots, double unshot)>;

/// Shoots until it reaches the tolerance or the number of shots, or `step`, if given, ends it. With
/// a mesh `fine` of the same room, the vertices of `fine` receive every shot, too, and make up the
/// solution's vertices. A fine mesh of 14,000 patches then takes as many shots as the coarse one,
/// not a hundred times as many. (Substructuring: M. Cohen, D. Greenberg, D. Immel and P. Brock, "An
/// Efficient Radiosity Approach for Realistic Image Synthesis", IEEE CG&A 6(3), 1986.)
Solution solve(const Mesh& mesh, const SolveParams& params, const Step& step = {},
               const Mesh* fine = nullptr);

/// Continues a solution of the same mesh with equal `sends`, as if it had not been interrupted.
Solution solve_further(const Mesh& mesh, const SolveParams& params, Solution begun,
                       const Step& step = {});

/// The centre of a patch as a vertex.
Vertex make_centre(const Patch& patch);

/// All indices of a mesh's vertices, and of its patches.
std::vector<std::uint32_t> all_vertices(const Mesh& mesh);
std::vector<std::uint32_t> all_patches(const Mesh& mesh);

/// The mesh of a room and its illumination.
struct LitRoom {
  Mesh mesh;
  std::vector<Rgb> vertices;  ///< radiosity, by vertex of the mesh
};

struct LightParams {
  MeshParams mesh;
  /// MeshParams::refine, 1 to 1000, of another mesh, best a coarser one, that sends the light to
  /// the vertices of this one; 0: the mesh itself sends it.
  int senders = 0;
  SolveParams solve;
  bool ambient = true;  ///< adds eval_ambient(), an estimate of the unsent light
};

/// The field senders.
base::Field<LightParams> senders_field();

/// The light at the vertices of `mesh`, one of the room's. Its own patches send it, or those of
/// another mesh of the room (params.senders). BadInput as make_mesh and solve.
Solution solve_room(const Room& room, const Mesh& mesh, const LightParams& params,
                    const Step& step = {});

/// The room must pass check(). BadInput as make_mesh and solve.
LitRoom light_room(const Room& room, const LightParams& params);

/// The area-weighted mean radiosity of the mesh's patches, over the three colours. Counts only
/// patches with materials that also occur in `other`.
double eval_mean_radiosity(const LitRoom& lit, const Mesh& other);

}  // namespace radiosity
