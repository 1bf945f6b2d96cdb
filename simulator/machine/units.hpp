#pragma once
// Units of time: simulated seconds and processor cycles. The types do not convert implicitly.
#include <compare>
#include <cstdint>

namespace machine {

struct Seconds {
  double value = 0;
  auto operator<=>(const Seconds&) const = default;
  Seconds& operator+=(Seconds o) { return value += o.value, *this; }
  Seconds& operator-=(Seconds o) { return value -= o.value, *this; }
};
inline Seconds operator+(Seconds a, Seconds b) { return {a.value + b.value}; }
inline Seconds operator-(Seconds a, Seconds b) { return {a.value - b.value}; }
inline Seconds operator*(double k, Seconds a) { return {k * a.value}; }
inline double operator/(Seconds a, Seconds b) { return a.value / b.value; }

struct Cycles {
  std::int64_t value = 0;
  auto operator<=>(const Cycles&) const = default;
  Cycles& operator+=(Cycles o) { return value += o.value, *this; }
};
inline Cycles operator+(Cycles a, Cycles b) { return {a.value + b.value}; }
inline Cycles operator*(std::int64_t k, Cycles a) { return {k * a.value}; }

/// Rounds to whole cycles, with halves away from zero, as std::llround does. Inline because it is
/// called for every simulated instruction. The absolute value of `cycles` must not exceed 2^52.
inline Cycles round_to_cycles(double cycles) {
  const auto whole = static_cast<std::int64_t>(cycles);
  const double rest = cycles - static_cast<double>(whole);
  return {whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0)};
}

struct Hertz {
  double value = 1;
};
inline Seconds operator/(Cycles c, Hertz f) { return {static_cast<double>(c.value) / f.value}; }

}  // namespace machine
