#pragma once
// Progressive refinement: the patch with most light to send sends it to every vertex, then the
// next (thesis, 1.2.2.2; M. Cohen et al., SIGGRAPH 1988). Form factors are kept in rows.hpp.

#include <functional>

#include "renderer/radiosity/light/balance.hpp"
#include "renderer/radiosity/light/form_factor.hpp"

namespace radiosity {

/// The light that a patch sends to all.
struct Shot {
  std::uint32_t patch = 0;
  Glow glow;         ///< the patch's unsent radiosity
  double power = 0;  ///< its sum over the colours, times the patch's area
};

/// How the unsent light of a patch is spread over it.
enum class Sends : std::uint8_t {
  mean,     ///< evenly, by J. Wallace and the thesis: too much comes from a dark edge or corner
  corners,  ///< bilinear, as its corners received it
};

/// The light of all vertices and patches. Where several share the work, the owner of a patch keeps
/// its light and that of its vertices up to date.
struct State {
  std::vector<Rgb> radiosity;  ///< by vertex
  std::vector<Rgb> unshot;     ///< by patch, the mean
  /// By patch, the mesh's: every shot reads them all, and the host finds them sooner side by side.
  std::vector<double> areas;
  /// By patch, what its corners have not sent; none for Sends::mean.
  std::vector<std::array<Rgb, 4>> in_corners;
  std::vector<Rgb> received;   ///< by vertex, the light that arrived in the last shot
  std::vector<Rgb> in_centre;  ///< by patch, the light that arrived at its centre in the last shot
  std::vector<Rgb> arrived;    ///< by patch, the light that has arrived in all shots, its mean
};

/// Everything emits, nothing is sent.
State make_state(const Mesh& mesh, Sends sends);

/// A shot of the patch, of those named, with most unsent power; of equals the first; none if all
/// are dark.
std::optional<Shot> find_shot(const Mesh& mesh, const State& state,
                              std::span<const std::uint32_t> patches, renderer::Work& work);

/// Each of the vertices named takes and reflects its share of the radiosity that the patch sends:
/// Eq 3.9 and 3.17. The patch may belong to another mesh of the same room.
void receive(const Eye& eye, const Sender& sender, std::span<const std::uint32_t> vertices,
             State& state, renderer::Work& work);

/// The centres of the patches named take their shares, for Mean::simpson.
void receive_in_centres(const Eye& eye, const Sender& sender,
                        std::span<const std::uint32_t> patches, State& state, renderer::Work& work);

/// How the light that a patch received is found from that of points on it.
enum class Mean : std::uint8_t {
  corners,  ///< the mean of the corners: exact for bilinear light; by J. Wallace and the thesis
  simpson,  ///< a twelfth of each corner's and two thirds of the centre's: exact for cubic light
};

/// Each of the patches named adds the mean of what it received to its unsent light; the one that
/// shot has sent all that it had. Their corners, and centres, must have received.
void settle(const Mesh& mesh, const Shot& shot, std::span<const std::uint32_t> patches, Mean mean,
            State& state, renderer::Work& work);

/// Power that has not been sent, in fixed point: a sum does not depend on its order.
struct Unshot {
  static constexpr double ONE = 1LL << 40;  ///< units in the power that the room emits
  std::int64_t r = 0, g = 0, b = 0;
  Unshot& operator+=(const Unshot& other);
  bool operator==(const Unshot&) const = default;
};
Unshot sum_unshot(const Mesh& mesh, const State& state, std::span<const std::uint32_t> patches);
/// The unsent share of the emitted power: 1 at first.
double eval_share(const Unshot& unshot);

/// Cohen's estimate of the light that the unsent power will yet give everywhere, if it is sent to
/// all alike and reflected again and again with the room's mean reflectance.
Rgb eval_ambient(const Mesh& mesh, const Unshot& unshot);
/// Adds to each vertex the ambient light times its reflectance.
void add_ambient(const Mesh& mesh, const Rgb& ambient, std::vector<Rgb>& vertices);

struct SolveParams {
  FactorParams factor;
  Mean mean = Mean::simpson;
  Sends sends = Sends::corners;
  int shots = 1'000'000;     ///< most shots, >= 0
  double tolerance = 0.001;  ///< unsent share of the emitted power at which it ends, 0..1
};

struct Solution {
  std::vector<Rgb> vertices;  ///< radiosity, by vertex, without ambient
  std::vector<Rgb> means;     ///< of the mesh that sends: mean radiosity by patch, without ambient
  Rgb ambient;                ///< see eval_ambient
  int shots = 0;
  double unshot = 0;  ///< share of the emitted power
  Balance balance;    ///< of the mesh that sends
  renderer::Work work;
  State state;  ///< of the mesh that sends: solve() can go on from it
};

/// The fields of the form factors, mean, sends, max_shots and tolerance.
base::Fields<SolveParams> solve_fields();

/// Is called after every shot with how many there were and what share is unsent; returns whether to
/// go on.
using Step = std::function<bool(int shots, double unshot)>;

/// Shoots until the tolerance or the number of shots is reached, or `step`, if given, says so. If
/// there is a mesh `fine` of the same room, its vertices receive every shot too, and the solution's
/// vertices are those of `fine`. A fine mesh of 14,000 patches takes as many shots as the coarse
/// one, not a hundred times as many. (Substructuring: M. Cohen, D. Greenberg, D. Immel and P.
/// Brock, "An Efficient Radiosity Approach for Realistic Image Synthesis", IEEE CG&A 6(3), 1986.)
Solution solve(const Mesh& mesh, const SolveParams& params, const Step& step = {},
               const Mesh* fine = nullptr);

/// Goes on from a solution of the same mesh that `sends` alike: what comes out is as if it had not
/// been left.
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
  bool ambient = true;  ///< whether eval_ambient(), an estimate of the unsent light, is added
};

/// The field senders.
base::Field<LightParams> senders_field();

/// The light at the vertices of `mesh`, one of the room's: its own patches send it, or those of
/// another mesh of the room (params.senders). BadInput as make_mesh and solve.
Solution solve_room(const Room& room, const Mesh& mesh, const LightParams& params,
                    const Step& step = {});

/// The room must pass check(). BadInput as make_mesh and solve.
LitRoom light_room(const Room& room, const LightParams& params);

/// The mean radiosity of the mesh's patches by area, over the three colours; only patches of
/// materials count that patches of `other` have too.
double eval_mean_radiosity(const LitRoom& lit, const Mesh& other);

}  // namespace radiosity
