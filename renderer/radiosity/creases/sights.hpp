#pragma once
// What of a straight way is seen through a point.

#include <cstddef>

#include "renderer/radiosity/room/planar.hpp"

namespace radiosity {

/// Sights through a point to the way from a to b.
struct Pencil {
  Vec apex, a, b;
};

/// The shares of the way that every pencil reaches past all faces except one; the pencils' ways are
/// one but for little. Sights begin at the apex or, if they come from `behind` it, before.
std::vector<Interval> find_seen(std::span<const std::vector<Vec>> faces, std::size_t except,
                                std::span<const Pencil> pencils, bool behind);

}  // namespace radiosity
