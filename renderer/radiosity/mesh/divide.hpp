#pragma once
// Subdivision of a face into convex quads.

#include <array>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

using Edge = std::array<std::uint32_t, 2>;  ///< between two points

struct Division {
  std::vector<Vec> points;
  std::vector<std::array<std::uint32_t, 4>> quads;  ///< counter-clockwise; neighbours share points
  std::vector<Edge> creases;                        ///< edges of quads that lie on a crease
  std::vector<Edge> contacts;                       ///< those of them on a contact
  std::size_t left_out = 0;  ///< creases that are not completely edges of quads
};

/// A face of 4 corners becomes a grid of along x across quads; any other a grid for each corner,
/// between the corner, the middles of its edges and the centre.
Division divide_face(const Face& face, int refine);
/// The grid lines of a face with 4 corners: its own, or even ones.
Grid find_grid(const Face& face, int refine);
/// Adds the middles of the marked steps between lines: the one after lines[i] if marks[i].
void halve(std::vector<double>& lines, const std::vector<bool>& marks);
/// The creases in the face's plane that lie on the face or no further off it than `touch`.
std::vector<Crease> select_creases(const Face& face, std::span<const Crease> creases, double touch);
/// The width of the face's narrowest quads, along its edges.
double find_patch_width(const Face& face, int refine);
/// The number of the face's quads.
std::size_t count_quads(const Face& face, int refine);
/// The number of a room's patches without creases, on all sides of its faces but mirrors.
std::size_t count_patches(const Room& room, int refine);

/// Maximum number of a room's patches.
inline constexpr std::size_t MOST_PATCHES = 10'000'000;

/// A crease or contact nearer to a vertex than this fraction of a patch's width is moved to it.
inline constexpr double CREASE_TOUCH = 0.1, CONTACT_TOUCH = 0.002;

/// Lines that may cut a face.
struct Cuts {
  std::span<const Crease> creases{};   ///< in order of importance
  std::span<const Crease> contacts{};  ///< where others touch the face; cut before all creases
  std::span<const Crease> folds{};     ///< like creases, but cut before them and never left out
  std::span<const Crease> strips{};    ///< like folds, but light is smooth there: no creases
  /// Limit for creases: a multiple of the face's number of patches without them.
  int growth = 1000;
};

/// The creases and contacts that lie in the face's plane and cross it become edges of quads.
/// Creases may be moved by a tenth of a patch's width, contacts by 0.002 of it, to existing edges;
/// shorter ones are not cut.
Division divide_face(const Face& face, int refine, const Cuts& cuts);

/// The point at (s, t), each 0..1, by bilinear interpolation of four corners.
Vec eval_bilinear(std::span<const Vec> corners, double s, double t);

}  // namespace radiosity
