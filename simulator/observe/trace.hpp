#pragma once
// A trace: the activities of all processors and link directions with their times. Also declares its
// file formats.
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "simulator/machine/cpu.hpp"

namespace observe {

/// Times are simulated seconds, at least 0 and within the window. Processors, processes, links and
/// channels are numbered by their indices in these vectors.
struct Trace {
  /// Activity of a processor during a span. Between spans it is idle.
  using Doing = machine::Observer::Doing;
  struct Process {
    std::string name;
    std::uint32_t processor;
  };
  struct Link {  ///< one direction, from processor to processor
    std::uint32_t from, to;
  };
  /// Spans of one processor do not overlap. During a switch, `process` has no meaning.
  struct Span {
    double from_s, to_s;
    std::uint32_t processor, process;
    Doing doing;
  };
  /// Transfers on one link direction do not overlap.
  struct Transfer {
    double from_s, to_s;
    std::uint32_t link, channel;
    std::uint64_t bytes;
  };
  std::vector<std::string> processors, channels;  ///< names in UTF-8
  std::vector<Process> processes;
  std::vector<Link> links;
  std::vector<Span> spans;          ///< sorted by time for each processor
  std::vector<Transfer> transfers;  ///< sorted by time for each link
  double begin_s = 0, end_s = 0;    ///< period that the trace covers
  std::string title;
};

// The writers throw base::InvariantBroken, before any output, for a trace that violates the rules
// above. The Trace Event Format and Paje store integer nanoseconds.

/// Writes the Trace Event Format (JSON) for Perfetto and chrome://tracing. Each processor becomes a
/// process with one track for its CPU and one for each outgoing link direction. An arrow leads from
/// a message on its link to the receiving CPU's next activity.
void save_chrome(const Trace& trace, std::ostream& out);

/// Writes the Paje format for ViTE and pj_dump: states of CPUs and link directions, and messages as
/// arrows between CPUs. In names, Paje cannot escape characters. Quotation marks become
/// apostrophes, backslashes become slashes, and control characters become spaces. An empty name
/// becomes "-".
void save_paje(const Trace& trace, std::ostream& out);

/// Draws a Gantt chart as SVG. Each CPU has a row, followed by thin rows for its outgoing link
/// directions with traffic. If a pixel's time contains several activities, their heights are in
/// proportion. Processors beyond 64 are counted but not drawn.
void save_timeline(const Trace& trace, std::ostream& out);

}  // namespace observe
