#pragma once
// One face cut into convex quads.

#include <array>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

using Edge = std::array<std::uint32_t, 2>;  ///< between two points

struct Division {
  std::vector<Vec> points;
  std::vector<std::array<std::uint32_t, 4>> quads;  ///< counter-clockwise; neighbours share points
  std::vector<Edge> creases;                        ///< edges of quads that lie on a crease
  std::vector<Edge> contacts;                       ///< those of them that lie on a contact
  std::size_t left_out = 0;  ///< creases that are not, or not everywhere, edges of quads
};

/// A face of 4 corners becomes a grid of along x across quads; any other a grid for each corner,
/// between the corner, the middles of its edges and the centre.
Division divide_face(const Face& face, int refine);
/// Its lines, if it has 4 corners: its own, or even ones.
Grid find_grid(const Face& face, int refine);
/// Adds the middles of the marked steps between lines: the one after lines[i] if marks[i].
void halve(std::vector<double>& lines, const std::vector<bool>& marks);
/// Those of the creases that lie in the face's plane, and on the face or no further off it than
/// `touch`.
std::vector<Crease> select_creases(const Face& face, std::span<const Crease> creases, double touch);
/// The width of its narrowest quads, along the face's edges.
double find_patch_width(const Face& face, int refine);
/// The number of its quads.
std::size_t count_quads(const Face& face, int refine);
/// That of a room without creases, on all sides of its faces but mirrors.
std::size_t count_patches(const Room& room, int refine);

/// That a room may have.
inline constexpr std::size_t MOST_PATCHES = 10'000'000;

/// A crease, and a contact, that is nearer to a vertex than this share of a patch's width is taken
/// to be there.
inline constexpr double CREASE_TOUCH = 0.1, CONTACT_TOUCH = 0.002;

/// What may cut a face.
struct Cuts {
  std::span<const Crease> creases{};   ///< the first count most
  std::span<const Crease> contacts{};  ///< where others touch the face: before all creases
  std::span<const Crease> folds{};     ///< as creases, but before them and never left out
  std::span<const Crease> strips{};    ///< likewise; light is smooth there: these are no creases
  /// Creases are left out once the face has this many times the patches that it has without.
  int growth = 1000;
};

/// The creases and contacts that lie in the face's plane and cross it become edges of quads.
/// Creases may be moved by a tenth of a patch's width, contacts by 0.002 of it, to where other
/// edges are; shorter ones are not cut.
Division divide_face(const Face& face, int refine, const Cuts& cuts);

/// The point at (s, t), each 0..1, by bilinear interpolation of four corners.
Vec eval_bilinear(std::span<const Vec> corners, double s, double t);

}  // namespace radiosity
