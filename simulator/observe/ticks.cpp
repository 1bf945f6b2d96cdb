#include "simulator/observe/ticks.hpp"

#include <algorithm>
#include <cmath>

namespace observe {

Ticks choose_ticks(double length_s, double most) {
  const double least_ns = std::max(length_s * 1e9 / most, 1.0);
  const double power = std::pow(10, std::floor(std::log10(least_ns)));
  double step = 10 * power;
  for (const double factor : {5, 2, 1})
    if (factor * power >= least_ns) step = factor * power;
  const auto ns = static_cast<std::int64_t>(std::llround(step));
  if (ns < 1'000) return {ns, 1, "ns"};
  if (ns < 1'000'000) return {ns, 1'000, "µs"};
  if (ns < 1'000'000'000) return {ns, 1'000'000, "ms"};
  return {ns, 1'000'000'000, "s"};
}

}  // namespace observe
