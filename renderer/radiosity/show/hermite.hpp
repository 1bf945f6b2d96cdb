#pragma once
// Hermite's bicubic surfaces (thesis, Eq 3.1 to 3.4).

#include <array>
#include <span>

#include "renderer/scene/vec.hpp"

namespace radiosity {

/// Indices of the value and the derivatives of a corner (s, t), each 0 or 1, in G_H, by rows
/// (Eq 3.4).
struct Slots {
  std::size_t value, by_s, by_t, by_st;
};
constexpr Slots find_slots(std::size_t s, std::size_t t) {
  return {4 * s + t, 4 * (s + 2) + t, 4 * s + t + 2, 4 * (s + 2) + t + 2};
}

/// S M_H, Eq 3.2 and 3.3.
constexpr std::array<double, 4> eval_hermite_basis(double s) {
  const double s2 = s * s, s3 = s2 * s;
  return {2 * s3 - 3 * s2 + 1, 3 * s2 - 2 * s3, s3 - 2 * s2 + s, s3 - s2};
}

/// The surface of G_H, given by rows, at (s, t): Eq 3.1.
inline renderer::Rgb eval_hermite(std::span<const renderer::Rgb, 16> g, double s, double t) {
  const auto hs = eval_hermite_basis(s), ht = eval_hermite_basis(t);
  renderer::Rgb sum;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) sum += hs[i] * ht[j] * g[4 * i + j];
  return sum;
}

}  // namespace radiosity
