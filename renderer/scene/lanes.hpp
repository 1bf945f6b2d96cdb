#pragma once
// SIMD arithmetic on LANES (four) numbers, points or colours. Each lane gets the same bits as a
// scalar computation. SIMD is faster on processors with wide registers.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "renderer/scene/vec.hpp"

// Lanes are passed only to inlined functions, so that no calling convention for SIMD types is
// needed.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace renderer {

inline constexpr std::size_t LANES = 4;

using Lanes = double __attribute__((vector_size(LANES * sizeof(double))));
/// Integers used as masks: a comparison gives -1 in lanes where it is true, and 0 in the others.
using Mask = std::int64_t __attribute__((vector_size(LANES * sizeof(std::int64_t))));

[[gnu::always_inline]] inline bool holds_any(const Mask& mask) {
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
}
/// Number of lanes that are set in the mask; for a sum of masks, the total over these masks.
[[gnu::always_inline]] inline std::uint64_t count(const Mask& mask) {
  return static_cast<std::uint64_t>(-(mask[0] + mask[1] + mask[2] + mask[3]));
}
[[gnu::always_inline]] inline std::int64_t min(const Mask& mask) {
  return std::min({mask[0], mask[1], mask[2], mask[3]});
}

struct Vecs {
  Lanes x, y, z;
  [[gnu::always_inline]] const Lanes& operator[](int axis) const {
    return axis == 0 ? x : axis == 1 ? y : z;
  }
};

[[gnu::always_inline]] inline Vecs operator-(const Vec& a, const Vecs& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline Vecs operator-(const Vecs& a, const Vec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline Vecs operator*(const Lanes& s, const Vecs& a) {
  return {s * a.x, s * a.y, s * a.z};
}
[[gnu::always_inline]] inline Lanes dot(const Vecs& a, const Vecs& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] inline Lanes dot(const Vecs& a, const Vec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

struct Rgbs {
  Lanes r, g, b;
};

[[gnu::always_inline]] inline Rgbs operator+(const Rgb& a, const Rgbs& b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
[[gnu::always_inline]] inline Rgbs operator+(const Rgbs& a, const Rgbs& b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
[[gnu::always_inline]] inline Rgbs operator*(const Lanes& s, const Rgb& a) {
  return {s * a.r, s * a.g, s * a.b};
}
[[gnu::always_inline]] inline Rgbs operator*(const Lanes& s, const Rgbs& a) {
  return {s * a.r, s * a.g, s * a.b};
}

[[gnu::always_inline]] inline Lanes sqrt(const Lanes& a) {
  return Lanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}
[[gnu::always_inline]] inline Lanes abs(const Lanes& a) { return a < 0.0 ? -a : a; }
/// std::min() and std::max(), in each lane.
[[gnu::always_inline]] inline Lanes min(const Lanes& a, const Lanes& b) { return b < a ? b : a; }
[[gnu::always_inline]] inline Lanes max(const Lanes& a, const Lanes& b) { return a < b ? b : a; }
/// std::clamp(), in each lane.
[[gnu::always_inline]] inline Lanes clamp(const Lanes& a, double lo, double hi) {
  const Lanes least = a < lo ? lo - Lanes{} : a;
  return hi < least ? hi - Lanes{} : least;
}

#if defined(__x86_64__) && defined(__GNUC__)
template <class Call>
[[gnu::target("avx2")]] void run_with_avx2(const Call& call) {
  call();
}
#endif

/// Calls a function that computes with Lanes, compiled for wide registers if the processor has
/// them. The call operator must be declared always_inline, and may pass Lanes by value only to
/// inlined functions. (The results are the same with or without wide registers, because AVX2 has no
/// fused multiply-add.)
template <class Call>
void run_in_lanes(const Call& call) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx2")) return run_with_avx2(call);
#endif
  call();
}

}  // namespace renderer

#pragma GCC diagnostic pop
