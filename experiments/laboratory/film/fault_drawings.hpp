#pragma once
// Drawings of a simulated fault: the network with a cycle of waits, and a time line of the last
// events.
#include "base/figure/figure_style.hpp"
#include "experiments/laboratory/points/points.hpp"
#include "simulator/observe/trace.hpp"
#include "topologies/draw/layout.hpp"

namespace laboratory {

/// Repeats a point that ended with a simulated fault, and draws it in files beside the results
/// folder. RESULTS-fault-timeline.svg is a time line of the last events. After a deadlock,
/// RESULTS-fault.svg shows the network with the processes that wait for each other. If `style` is
/// that of a figure, both are also written as PDF in this style. In a sweep, the names contain the
/// axes of the point. Returns a text that lists the files, for the end of the failure's message.
///
/// Returns "" for other failures, for a fault before the simulation begins, and if a repetition is
/// not possible (timed costs) or would take more than a minute.
std::string draw_fault(const Point& point, const RunOptions& options, const PointResult& failure,
                       const base::FigureStyle& style);

/// Makes a function for PointsPlan that calls draw_fault() with this style.
Explain draw_faults(const base::FigureStyle& style);

/// Draws a machine with the cycle of waits of a trace as SVG. `places` are the positions of the
/// processors.
std::string draw_waits(const observe::Trace& trace, const topologies::Places& places,
                       const base::FigureStyle& style = {});

}  // namespace laboratory
