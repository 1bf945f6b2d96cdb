// Loads of the resources of a point (processors, links and others), and its bottleneck.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/report/simulation.hpp"
#include "simulator/ray_tracing/busy.hpp"

namespace laboratory {

struct PointLoads {
  /// values of the point's axes, "topology = tree, workers = 7"; "" for the only point
  std::string name;
  std::string ended;                  ///< how the simulation ended (see PointResult)
  std::vector<programs::Load> loads;  ///< loads that are not zero, the busiest resource first
};

/// Reads the loads of each point of the table from its record in `folder`. These are the loads of
/// the resources that the program describes ("coordination", "workers"), or else the loads of the
/// busiest processor and link.
std::vector<PointLoads> load_loads(const std::filesystem::path& folder, const Simulation& s);

/// A resource limits a point if it is the busiest, and is busy for at least this share of the time.
inline constexpr double SATURATED = ray_tracing::SATURATED;

/// The bottleneck of a point: the first of its loads, or null if that resource is not saturated.
const programs::Load* find_limit(const PointLoads& point);

/// Formats a load, with what the resource was doing: "coordination 0.98: its CPU 42 %, waiting for
/// replies 52 %".
std::string tell_load(const programs::Load& load);

/// Explains why a point is not faster: "Limited by coordination 0.98: its CPU 42 %, waiting for
/// replies 52 %.", or names the busiest resource if nothing is saturated. Returns "" if loads were
/// not measured.
std::string explain(const PointLoads& point);

}  // namespace laboratory
