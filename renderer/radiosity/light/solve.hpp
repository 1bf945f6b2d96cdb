#pragma once
// Progressive refinement: the patch with most light to send sends it to every vertex, then the
// next (thesis, 1.2.2.2; M. Cohen et al., SIGGRAPH 1988). No form factor is kept.

#include <functional>

#include "renderer/radiosity/light/form_factor.hpp"

namespace radiosity {

/// A patch's light, sent to all: what everybody needs to know of it.
struct Shot {
  std::uint32_t patch = 0;
  Rgb radiosity;     ///< that had not been sent, of the patch
  double power = 0;  ///< its sum over the colours, times the patch's area
};

/// Of every vertex and patch. Whoever owns some of the patches keeps theirs, and their vertices',
/// up to date.
struct State {
  std::vector<Rgb> radiosity;  ///< by vertex
  std::vector<Rgb> unshot;     ///< by patch
  std::vector<Rgb> received;   ///< by vertex, in the last shot
  std::vector<Rgb> in_centre;  ///< by patch: what its centre received in the last shot
};

/// Everything emits, nothing is sent.
State make_state(const Mesh& mesh);

/// Of the patches named the one with most power to send, of equals the first; none if all are dark.
std::optional<Shot> find_shot(const Mesh& mesh, const State& state,
                              std::span<const std::uint32_t> patches, renderer::Work& work);

/// Each of the vertices named takes its share of what the patch sends: Eq 3.9 and 3.17. The patch
/// may be of another mesh of the same room.
void receive(const Eye& eye, const Patch& sender, const Rgb& radiosity,
             std::span<const std::uint32_t> vertices, State& state, renderer::Work& work);

/// The same of the centres of the patches named, for Mean::simpson.
void receive_in_centres(const Eye& eye, const Patch& sender, const Rgb& radiosity,
                        std::span<const std::uint32_t> patches, State& state, renderer::Work& work);

/// What a patch has of light, of what is found in points of it.
enum class Mean : std::uint8_t {
  corners,  ///< the four corners' mean: exact for bilinear light. J. Wallace's, and the thesis's
  simpson,  ///< a twelfth of each corner's and two thirds of the centre's: exact for cubic light
};

/// Each of the patches named adds to what it has to send the mean of what it received; the one that
/// shot has sent all that it had. Their corners, and centres, must have received.
void settle(const Mesh& mesh, const Shot& shot, std::span<const std::uint32_t> patches, Mean mean,
            State& state, renderer::Work& work);

/// Power that has not been sent, in fixed point: a sum does not depend on its order.
struct Unshot {
  static constexpr double ONE = 1LL << 40;  ///< units of all the power that the room emits
  std::int64_t r = 0, g = 0, b = 0;
  Unshot& operator+=(const Unshot& other);
  bool operator==(const Unshot&) const = default;
};
Unshot sum_unshot(const Mesh& mesh, const State& state, std::span<const std::uint32_t> patches);
/// The share of the emitted power: 1 at first.
double eval_share(const Unshot& unshot);

/// Cohen's estimate of what the unsent power will yet give, everywhere: sent to all alike, and
/// reflected on and on with the room's mean reflectance. A surface adds its reflectance times it.
Rgb eval_ambient(const Mesh& mesh, const Unshot& unshot);
void add_ambient(const Mesh& mesh, const Rgb& ambient, std::vector<Rgb>& vertices);

struct SolveParams {
  FactorParams factor;
  Mean mean = Mean::simpson;
  int shots = 1'000'000;     ///< at most, >= 0
  double tolerance = 0.001;  ///< until so much of the emitted power is unsent, 0..1
};

struct Solution {
  std::vector<Rgb> vertices;  ///< radiosity, by vertex, without ambient
  Rgb ambient;                ///< see eval_ambient
  int shots = 0;
  double unshot = 0;  ///< share of the emitted power
  renderer::Work work;
};

/// Shoots until the tolerance or the number of shots is reached. `step`, if given, is called after
/// every shot with how many there were and what share is unsent; it returns whether to go on.
Solution solve(const Mesh& mesh, const SolveParams& params,
               const std::function<bool(int shots, double unshot)>& step = nullptr);

/// The oracle: the same equations by gathering (Eq 1.8 with Eq 3.9), sweep after sweep in the order
/// of vertices, until none changes by more than `tolerance` of the brightest. Every factor is
/// found again in every sweep, `shots` of them; for small rooms.
Solution gather(const Mesh& mesh, const SolveParams& params, double tolerance = 1e-6);

/// A patch's centre as a vertex.
Vertex make_centre(const Patch& patch);

/// All indices of a mesh: of the vertices, and of the patches.
std::vector<std::uint32_t> all_vertices(const Mesh& mesh);
std::vector<std::uint32_t> all_patches(const Mesh& mesh);

}  // namespace radiosity
