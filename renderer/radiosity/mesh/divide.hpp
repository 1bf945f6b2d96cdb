#pragma once
// Subdivision of a face into convex quads.

#include <array>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

using Edge = std::array<std::uint32_t, 2>;  ///< indices of two points

struct Division {
  std::vector<Vec> points;
  /// point indices, counter-clockwise; neighbours share points
  std::vector<std::array<std::uint32_t, 4>> quads;
  std::vector<Edge> creases;   ///< edges of quads that lie on a crease
  std::vector<Edge> contacts;  ///< edges of quads that lie on a contact, also in `creases`
  std::size_t left_out = 0;    ///< number of creases that are not completely edges of quads
};

/// Divides a face. A face of 4 corners becomes a grid of along x across quads. Any other face
/// becomes several grids, one for each corner, between the corner, the middles of the adjacent
/// edges, and the centre.
Division divide_face(const Face& face, int refine);
/// The grid lines of a face with 4 corners: its own grid, or even lines.
Grid find_grid(const Face& face, int refine);
/// Halves the marked steps between lines. Step i is the one after lines[i].
void halve(std::vector<double>& lines, const std::vector<bool>& marks);
/// The creases in the plane of a face that lie on the face, or outside it by at most `touch`.
std::vector<Crease> select_creases(const Face& face, std::span<const Crease> creases, double touch);
/// The width of the narrowest quads of a face, along its edges.
double find_patch_width(const Face& face, int refine);
/// The number of quads of a face.
std::size_t count_quads(const Face& face, int refine);
/// The number of patches of a room without creases, on all sides of its faces except mirrors.
std::size_t count_patches(const Room& room, int refine);

/// Limit on the number of patches of a room.
inline constexpr std::size_t MOST_PATCHES = 10'000'000;

/// A crease or contact is moved to a vertex that is nearer than this fraction of a patch's width.
inline constexpr double CREASE_TOUCH = 0.1, CONTACT_TOUCH = 0.002;

/// Lines that may cut a face.
struct Cuts {
  std::span<const Crease> creases{};  ///< creases, the most important ones first
  /// contacts with other faces, which are cut before all creases
  std::span<const Crease> contacts{};
  std::span<const Crease> folds{};   ///< lines that are cut before creases and never left out
  std::span<const Crease> strips{};  ///< like folds, but the illumination is smooth there
  /// Limit on the number of patches with creases, as a multiple of the number without creases.
  int growth = 1000;
};

/// Divides a face such that creases and contacts in its plane become edges of quads. To meet
/// existing edges, a crease may be moved by a tenth of a patch's width, and a contact by 0.002 of
/// it. Lines shorter than this are left out.
Division divide_face(const Face& face, int refine, const Cuts& cuts);

/// Bilinear interpolation of four corners at (s, t), each 0..1.
Vec eval_bilinear(std::span<const Vec> corners, double s, double t);

}  // namespace radiosity
