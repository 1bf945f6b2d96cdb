#pragma once
// What limits a farm: which of its resources is busy when others wait for it.
#include <string>
#include <vector>

#include "simulator/declare/program.hpp"
#include "simulator/farm/farm.hpp"

namespace farm {

using programs::Load;

/// The resources that can limit the farm, such as "worker1 (routing)", the busiest first:
/// - "workers": their CPUs on average, with how much of it was routing;
/// - "workerN (routing)": the routers of the one that routes most, at high priority;
/// - "coordination": the process, whenever it was not waiting for its workers: it takes turns with
///   the ray database and the display, so that it can be the limit while its CPU is idle;
/// - "database", "display": their CPUs, where they have processors of their own;
/// - "link A>B": the busiest direction of a link;
/// - "tasks": the share of the time after the last task was handed out, when workers end one after
///   the other.
/// Empty for a run that was cut short before its first task.
std::vector<Load> find_loads(const Result& result);

/// The busiest resource limits the farm if it was busy for at least this share of the time; else
/// nothing does: all wait for messages that are on their way.
constexpr double SATURATED = 0.8;

}  // namespace farm
