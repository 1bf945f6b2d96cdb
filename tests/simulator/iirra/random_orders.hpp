#pragma once
// Makes random topologies, limits, orders of the user and parameters of distributed data for IIRRA.
#include <fmt/format.h>

#include <random>
#include <string>
#include <vector>

#include "simulator/iirra/iirra.hpp"
#include "simulator/ray_tracing/data.hpp"

namespace iirra {

using Random = std::mt19937_64;
inline int below(Random& random, int n) {
  return static_cast<int>(random() % static_cast<unsigned>(n));
}

// Returns the specification of a topology of 3 to 20 processors.
inline std::string random_topology(Random& random) {
  const auto from = [&](int least, int most) { return least + below(random, most - least + 1); };
  switch (below(random, 7)) {
    case 0:
      return fmt::format("line:{}", from(3, 7));
    case 1:
      return fmt::format("ring:{}", from(3, 10));
    case 2:
      return fmt::format("mesh:{}x{}", from(2, 4), from(2, 5));
    case 3:
      return fmt::format("torus:{}x{}", from(2, 4), from(2, 5));
    case 4:
      return fmt::format("tree:{}", from(3, 20));
    case 5:
      return fmt::format("hypercube:{}", from(2, 4));
    default:
      return fmt::format("amp:{}", from(3, 18));
  }
}

inline Limits random_limits(Random& random, const renderer::Area& area) {
  Limits limits;
  limits.min_influence = below(random, 4) / 4.0;
  limits.depth_reflected = below(random, 5);
  limits.depth_transmitted = below(random, 5);
  limits.min_cell = 1 << random() % 5;
  limits.max_samples = 5 + below(random, 9);
  limits.min_contrast = below(random, 4) / 8.0;
  if (random() % 3 == 0)
    limits.area = {area.x + below(random, area.width - 1), area.y + below(random, area.height - 1),
                   1, 1 + below(random, 2)};
  if (random() % 3 == 0) limits.weights = Weights{double(random() % 3), 1, 0, 2, 0, 1};
  return limits;
}

inline std::vector<Order> random_script(Random& random, const renderer::Area& area) {
  std::vector<Order> script;
  double at_s = 0;
  for (int n = below(random, 5); n-- > 0;) {
    at_s += 0.05 * below(random, 12);
    Order order{{at_s}, random_limits(random, area)};
    switch (below(random, 9)) {
      case 0:
        order.what = ray_tracing::NonInteractive{};
        break;
      case 1:
        order.what = ray_tracing::Interactive{};
        break;
      case 2:
        order.what = ray_tracing::Save{fmt::format("kept-{}", script.size())};
        break;
      case 3:
        if (n == 0) order.what = ray_tracing::Abort{};
        break;
      default:
        break;
    }
    script.push_back(order);
  }
  return script;
}

inline ray_tracing::SharedParams random_data(Random& random, network::Method method) {
  ray_tracing::SharedParams data;
  data.cache_percent = 40 + below(random, 61);
  data.server_cache_percent = 50 + below(random, 51);
  data.scheme = random() % 2 ? shared_memory::Scheme::pages : shared_memory::Scheme::items;
  data.page_items = 1 + below(random, 2);
  data.in_path = random() % 2;
  data.waiting_queue = random() % 2;
  data.method = method;
  return data;
}

}  // namespace iirra
