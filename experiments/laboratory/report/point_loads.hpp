// Loads of a point's resources, and its bottleneck.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/report/simulation.hpp"
#include "simulator/ray_tracing/busy.hpp"

namespace laboratory {

struct PointLoads {
  std::string name;   ///< name of the point, "topology = tree, workers = 7"; "": the only point
  std::string ended;  ///< how the point ended (see PointResult)
  std::vector<programs::Load> loads;  ///< non-zero loads, the busiest first
};

/// Reads the loads of each point of the table from its record in `folder`. These are the loads of
/// the program's own categories ("coordination", "workers") if it has any, else those of the
/// busiest processor and link.
std::vector<PointLoads> load_loads(const std::filesystem::path& folder, const Simulation& s);

/// A resource limits a point if it is the busiest and busy for at least this share of the time.
inline constexpr double SATURATED = ray_tracing::SATURATED;

/// The bottleneck of a point: the first of its loads; null if nothing is saturated.
const programs::Load* find_limit(const PointLoads& point);

/// Formats a load: "coordination 0.98: its CPU 42 %, waiting for replies 52 %".
std::string tell_load(const programs::Load& load);

/// Tells why a point is not faster: "Limited by coordination 0.98: its CPU 42 %, waiting for
/// replies 52 %.", or names the busiest resource if nothing is saturated. Returns "" without
/// measurements.
std::string explain(const PointLoads& point);

}  // namespace laboratory
