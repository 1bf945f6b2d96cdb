#pragma once
// Division of a face into convex quads, which become the patches of a mesh.

#include <array>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

using Edge = std::array<std::uint32_t, 2>;  ///< indices of two points

struct Division {
  std::vector<Vec> points;
  /// Indices of four points, counter-clockwise. Neighbouring quads share points.
  std::vector<std::array<std::uint32_t, 4>> quads;
  std::vector<Edge> creases;   ///< edges of quads that lie on a crease or contact
  std::vector<Edge> contacts;  ///< those edges of `creases` that lie on a contact
  std::size_t left_out = 0;    ///< number of creases that did not completely become edges
};

/// Divides a face into quads, ignoring creases and contacts. A face of 4 corners becomes a grid
/// with Face::along x Face::across quads, multiplied by `refine` each way. Any other face becomes
/// several grids, one per corner: between the corner, the middles of the adjacent edges, and the
/// centre.
Division divide_face(const Face& face, int refine);
/// The grid lines of a face with 4 corners: those of Face::grid, or evenly spaced ones.
Grid find_grid(const Face& face, int refine);
/// Halves the marked steps between lines. marks[i] is for the step after lines[i].
void halve(std::vector<double>& lines, const std::vector<bool>& marks);
/// The creases that lie in the plane of a face, and either on the face or at most `touch` outside
/// it.
std::vector<Crease> select_creases(const Face& face, std::span<const Crease> creases, double touch);
/// The width of the narrowest quads of a face, along its edges.
double find_patch_width(const Face& face, int refine);
/// The number of quads that divide_face() makes without creases.
std::size_t count_quads(const Face& face, int refine);
/// The number of patches in a room without creases. Counts both sides of two-sided faces, but no
/// mirrors.
std::size_t count_patches(const Room& room, int refine);

/// Limit on the number of patches of a room.
inline constexpr std::size_t MOST_PATCHES = 10'000'000;

/// A crease or contact is moved to a vertex that is nearer than this fraction of a patch's width.
inline constexpr double CREASE_TOUCH = 0.1, CONTACT_TOUCH = 0.002;

/// Lines along which a face may be divided.
struct Cuts {
  std::span<const Crease> creases{};  ///< creases, the most important ones first
  /// Contacts with other faces. They are cut before all creases.
  std::span<const Crease> contacts{};
  /// Lines below open edges; cut before creases and never omitted.
  std::span<const Crease> folds{};
  /// Lines beside folds. The face is cut along them as along folds, but the light is smooth there.
  std::span<const Crease> strips{};
  /// Limit on the number of a face's patches, as a multiple of the number without creases.
  int growth = 1000;
};

/// Divides a face so that creases and contacts in its plane become edges of quads. To coincide with
/// existing edges, a crease may be moved by a tenth of a patch's width, and a contact by 0.002 of
/// it. Lines shorter than these distances are omitted.
Division divide_face(const Face& face, int refine, const Cuts& cuts);

/// Interpolates bilinearly between four corners at the parameters (s, t), each from 0 to 1.
Vec eval_bilinear(std::span<const Vec> corners, double s, double t);

}  // namespace radiosity
