// How busy the resources of a point were, and what limits it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/report/simulation.hpp"
#include "simulator/tracing/busy.hpp"

namespace laboratory {

struct PointLoads {
  std::string name;                   ///< "topology = tree, workers = 7"; "" for the only point
  std::string ended;                  ///< as PointResult has it
  std::vector<programs::Load> loads;  ///< that are not 0, the busiest first
};

/// The loads of each point of the table, from the records in `folder`: those that its program tells
/// apart ("coordination", "workers"), else those of the busiest processor and link.
std::vector<PointLoads> load_loads(const std::filesystem::path& folder, const Simulation& s);

/// The busiest resource of a point limits it if it was busy for at least this share of the time.
inline constexpr double SATURATED = tracing::SATURATED;

/// The resource that limits the point, the first of its loads; null if nothing is saturated.
const programs::Load* find_limit(const PointLoads& point);

/// A load in words: "coordination 0.98: its CPU 42 %, waiting for replies 52 %".
std::string tell_load(const programs::Load& load);

/// Why a point is not faster: "Limited by coordination 0.98: its CPU 42 %, waiting for replies 52
/// %.", or what is busiest where nothing is saturated; "" where nothing was measured.
std::string explain(const PointLoads& point);

}  // namespace laboratory
