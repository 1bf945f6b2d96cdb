// Loads of a point's resources, and its limiting resource.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/report/simulation.hpp"
#include "simulator/ray_tracing/busy.hpp"

namespace laboratory {

struct PointLoads {
  std::string name;                   ///< "topology = tree, workers = 7"; "" for the only point
  std::string ended;                  ///< as PointResult has it
  std::vector<programs::Load> loads;  ///< non-zero loads, the busiest first
};

/// The loads of each point of the table, from the records in `folder`: those of the program's own
/// categories ("coordination", "workers"), else those of the busiest processor and link.
std::vector<PointLoads> load_loads(const std::filesystem::path& folder, const Simulation& s);

/// A point is limited by its busiest resource if that was busy for at least this share of the time.
inline constexpr double SATURATED = ray_tracing::SATURATED;

/// The limiting resource of the point, the first of its loads; null if nothing is saturated.
const programs::Load* find_limit(const PointLoads& point);

/// A load in words: "coordination 0.98: its CPU 42 %, waiting for replies 52 %".
std::string tell_load(const programs::Load& load);

/// The reason why a point is not faster: "Limited by coordination 0.98: its CPU 42 %, waiting for
/// replies 52 %.", or the busiest resource if nothing is saturated; "" without measurements.
std::string explain(const PointLoads& point);

}  // namespace laboratory
