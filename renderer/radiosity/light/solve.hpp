#pragma once
// Progressive radiosity (M. Cohen et al., SIGGRAPH 1988; thesis, 1.2.2.2). Repeatedly, the patch
// with the most unsent light sends it to every vertex. rows.hpp keeps form factors between shots.

#include <functional>

#include "renderer/radiosity/light/balance.hpp"
#include "renderer/radiosity/light/form_factor.hpp"

namespace radiosity {

/// A shot: the light of one patch, sent to all vertices.
struct Shot {
  std::uint32_t patch = 0;
  Glow glow;         ///< unsent radiosity of the patch
  double power = 0;  ///< sum of `glow` over the colours, times the area of the patch
};

/// Distribution of the light that a patch sends over its area.
enum class Sends : std::uint8_t {
  mean,     ///< constant, as by J. Wallace and in the thesis; dark parts of patches send too much
  corners,  ///< bilinear, as received by the corners
};

/// The light of all vertices and patches. In a parallel run, the owner of a patch updates the light
/// of the patch and of its vertices.
struct State {
  std::vector<Rgb> radiosity;  ///< radiosity of each vertex
  std::vector<Rgb> unshot;     ///< mean unsent radiosity of each patch
  /// Area of each patch, copied from the mesh. Every shot reads all areas, and contiguous reads are
  /// faster.
  std::vector<double> areas;
  /// Unsent light at the corners of each patch; empty for Sends::mean.
  std::vector<std::array<Rgb, 4>> in_corners;
  std::vector<Rgb> received;   ///< light that each vertex received in the last shot
  std::vector<Rgb> in_centre;  ///< light that the centre of each patch received in the last shot
  std::vector<Rgb> arrived;    ///< mean light that each patch has received in all shots
};

/// Makes the initial state: all emission is unsent.
State make_state(const Mesh& mesh, Sends sends);

/// Makes the shot of the patch in `patches` with the most unsent power; of equal ones, the first.
/// None if no patch has unsent power.
std::optional<Shot> find_shot(const Mesh& mesh, const State& state,
                              std::span<const std::uint32_t> patches, renderer::Work& work);

/// Adds the light of the sender that the given vertices reflect to their radiosity (Eq 3.9 and
/// 3.17). The sender may belong to another mesh of the same room.
void receive(const Eye& eye, const Sender& sender, std::span<const std::uint32_t> vertices,
             State& state, renderer::Work& work);

/// Computes the light at the centres of the given patches, for Mean::simpson.
void receive_in_centres(const Eye& eye, const Sender& sender,
                        std::span<const std::uint32_t> patches, State& state, renderer::Work& work);

/// Estimator of a patch's mean received light.
enum class Mean : std::uint8_t {
  corners,  ///< mean of the corners, as by J. Wallace and in the thesis; exact for bilinear light
  simpson,  ///< 1/12 of each corner and 2/3 of the centre; exact for cubic light
};

/// Adds the reflected part of the mean received light to the unsent light of the given patches, and
/// clears the unsent light of the patch that shot. Before, the corners and centres of the patches
/// must have received the shot.
void settle(const Mesh& mesh, const Shot& shot, std::span<const std::uint32_t> patches, Mean mean,
            State& state, renderer::Work& work);

/// Unsent power in fixed point, whose sum does not depend on the order.
struct Unshot {
  static constexpr double ONE = 1LL << 40;  ///< units in the power that the room emits
  std::int64_t r = 0, g = 0, b = 0;
  Unshot& operator+=(const Unshot& other);
  bool operator==(const Unshot&) const = default;
};
Unshot sum_unshot(const Mesh& mesh, const State& state, std::span<const std::uint32_t> patches);
/// The unsent fraction of the emitted power, initially 1.
double eval_share(const Unshot& unshot);

/// Cohen's ambient term: the light from the unsent power if it spreads evenly over the room and is
/// reflected repeatedly, with the room's mean reflectance.
Rgb eval_ambient(const Mesh& mesh, const Unshot& unshot);
/// Adds to each vertex the ambient light times the vertex's reflectance.
void add_ambient(const Mesh& mesh, const Rgb& ambient, std::vector<Rgb>& vertices);

struct SolveParams {
  FactorParams factor;
  Mean mean = Mean::simpson;
  Sends sends = Sends::corners;
  int shots = 1'000'000;  ///< limit on the number of shots, >= 0
  /// unsent fraction of the emitted power at which the solution ends, 0..1
  double tolerance = 0.001;
};

struct Solution {
  std::vector<Rgb> vertices;  ///< radiosity of each vertex, without ambient light
  /// mean radiosity of each patch of the sending mesh, without ambient light
  std::vector<Rgb> means;
  Rgb ambient;  ///< ambient term (see eval_ambient)
  int shots = 0;
  double unshot = 0;  ///< unsent fraction of the emitted power
  Balance balance;    ///< energy balance of the sending mesh
  renderer::Work work;
  State state;  ///< state of the sending mesh, for solve_further()
};

/// Makes the fields of the form factors, mean, sends, max_shots and tolerance.
base::Fields<SolveParams> solve_fields();

/// Callback after every shot, with the number of shots and the unsent fraction. Returning false
/// ends the solution.
using Step = std::function<bool(int shots, double unshot)>;

/// Shoots until the tolerance or the number of shots is reached, or until `step`, if given, ends
/// it. If `fine`, another mesh of the room, is given, its vertices receive every shot too, and
/// become the vertices of the solution. The number of shots is then that of the coarse mesh; a mesh
/// of 14,000 patches would take a hundred times as many. (Substructuring: M. Cohen, D. Greenberg,
/// D. Immel and P. Brock, "An Efficient Radiosity Approach for Realistic Image Synthesis", IEEE
/// CG&A 6(3), 1986.)
Solution solve(const Mesh& mesh, const SolveParams& params, const Step& step = {},
               const Mesh* fine = nullptr);

/// Continues a solution of the same mesh with equal `sends` as if the solution had not been
/// interrupted.
Solution solve_further(const Mesh& mesh, const SolveParams& params, Solution begun,
                       const Step& step = {});

/// The centre of a patch as a vertex.
Vertex make_centre(const Patch& patch);

/// The indices of all vertices, and of all patches, of a mesh.
std::vector<std::uint32_t> all_vertices(const Mesh& mesh);
std::vector<std::uint32_t> all_patches(const Mesh& mesh);

/// The mesh of a room and its illumination.
struct LitRoom {
  Mesh mesh;
  std::vector<Rgb> vertices;  ///< radiosity of each vertex of the mesh
};

struct LightParams {
  MeshParams mesh;
  /// MeshParams::refine, 1 to 1000, of a separate mesh whose patches send the light; it should be
  /// coarser than the mesh that receives it. 0: the patches of the receiving mesh send.
  int senders = 0;
  SolveParams solve;
  bool ambient = true;  ///< adds eval_ambient(), an estimate of the unsent light
};

/// Makes the field senders.
base::Field<LightParams> senders_field();

/// Computes the light at the vertices of `mesh`, a mesh of the room. Its own patches send light, or
/// those of a separate mesh (params.senders). Throws BadInput as make_mesh and solve do.
Solution solve_room(const Room& room, const Mesh& mesh, const LightParams& params,
                    const Step& step = {});

/// Makes a mesh of the room and computes its light. The room must pass check(). Throws BadInput as
/// make_mesh and solve do.
LitRoom light_room(const Room& room, const LightParams& params);

/// The area-weighted mean radiosity of the mesh's patches and of the three colours. Counts only
/// patches whose materials also occur in `other`.
double eval_mean_radiosity(const LitRoom& lit, const Mesh& other);

}  // namespace radiosity
