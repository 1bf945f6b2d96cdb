#pragma once
// The patches around every vertex, and where a surface ends.

#include <optional>
#include <span>

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// A patch's corner, as the vertex there sees it. An edge that a second patch at the vertex shares
/// is an inner one, any other a border.
struct Wedge {
  std::uint32_t patch = 0;
  std::uint32_t corner = 0;          ///< 0..3
  std::uint32_t next = 0, prev = 0;  ///< vertices at the other ends of the corner's edges
  bool next_inner = false, prev_inner = false;
  double trust = 1;  ///< of what its corners tell of slopes: see find_trust
};

enum class Place : std::uint8_t {
  inner,     ///< wholly surrounded by patches
  straight,  ///< on a border that passes straight through
  corner     ///< where a border turns, or several meet; also a vertex without patches
};

struct Fans {
  std::vector<Wedge> wedges;         ///< by vertex, of each by patch
  std::vector<std::uint32_t> first;  ///< where a vertex's begin; one more than vertices
  std::vector<Place> places;         ///< by vertex
  std::vector<std::uint32_t> twins;  ///< by vertex: the next that a crease has split from the same;
                                     ///< round in a ring, so itself if there is none

  std::span<const Wedge> at(std::size_t vertex) const {
    return std::span(wedges).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};

Fans make_fans(const Mesh& mesh);

/// 1; of an edge less than a third as long as the one that it continues, or that continues it,
/// (3 |edge| / |other|)^2. What is off a little at the end of a short edge, and makes a steep slope
/// there, would be far off within the long one's patches.
double find_trust(double edge, double other);

/// Vertices that a crease has split: of one place, normal and material. They have the same
/// illumination.
bool are_twins(const Vertex& a, const Vertex& b);

/// The neighbours on the border that passes a vertex, first the one from which the patches are on
/// the left. None inside, nor where several borders meet.
struct Border {
  std::uint32_t after = 0, before = 0;
};
std::optional<Border> find_border(std::span<const Wedge> wedges);

/// The way to a neighbour, laid in the tangent plane of a vertex at its full length.
Vec unfold(const Vertex& vertex, const Vec& to);

}  // namespace radiosity
