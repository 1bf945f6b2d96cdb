#pragma once
// A trace: the activities of all processors and link directions, with their times. Also declares
// the functions that write traces in several file formats.
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "base/figure/figure_style.hpp"
#include "simulator/machine/cpu.hpp"

namespace observe {

/// All times are simulated seconds, at least 0 and within the period from begin_s to end_s.
/// Processors, processes, links and channels are identified by their indices in the vectors below.
struct Trace {
  /// Activity of a processor during a span. Between two spans, the processor is idle.
  using Doing = machine::Observer::Doing;
  struct Process {
    std::string name;
    std::uint32_t processor;
  };
  struct Link {  ///< one direction of a link, given by the processors at its ends
    std::uint32_t from, to;
  };
  /// Spans of one processor do not overlap. During a context switch, `process` has no meaning.
  struct Span {
    double from_s, to_s;
    std::uint32_t processor, process;
    Doing doing;
  };
  /// A message on one direction of a link. Messages on one direction do not overlap.
  struct Transfer {
    double from_s, to_s;
    std::uint32_t link, channel;
    std::uint64_t bytes;
  };
  /// A process that waits when the run has ended with a deadlock.
  struct Waiting {
    std::string process, what;  ///< its name, and what it waits for
    std::uint32_t processor;
  };
  std::vector<std::string> processors, channels;  ///< names in UTF-8
  std::vector<Process> processes;
  std::vector<Link> links;
  std::vector<Span> spans;          ///< sorted by time within each processor
  std::vector<Transfer> transfers;  ///< sorted by time within each link
  double begin_s = 0, end_s = 0;    ///< period that the trace covers
  std::string title;
  std::string fault;  ///< the fault that ended the run, in one line; "" for none
  /// The processes that wait after a deadlock; those of a cycle come first, in its order.
  std::vector<Waiting> waiting;
  std::size_t cycle = 0;  ///< number of processes in the cycle; each waits for the next
};

// The writers throw base::InvariantBroken, before writing anything, for a trace that violates the
// rules stated in struct Trace. The Trace Event Format and Paje store times as whole nanoseconds.

/// Writes the Trace Event Format (JSON), which Perfetto and chrome://tracing can show. Each
/// processor becomes a process of the viewer, with one track for its CPU and one for each outgoing
/// link direction. An arrow leads from a message on a link to the next activity of the receiving
/// CPU.
void save_chrome(const Trace& trace, std::ostream& out);

/// Writes the Paje format, which ViTE and pj_dump read: states of CPUs and link directions, and
/// messages as arrows between CPUs. Names in Paje cannot contain escaped characters. Quotation
/// marks are therefore replaced by apostrophes, backslashes by slashes, control characters by
/// spaces, and an empty name by "-".
void save_paje(const Trace& trace, std::ostream& out);

/// Draws a Gantt chart as SVG. Each CPU has a row, followed by thin rows for its outgoing link
/// directions that carried messages. If several activities fall into one pixel column, their
/// heights show their fractions of the time. Draws at most 64 processors; the others are only
/// counted.
void save_timeline(const Trace& trace, std::ostream& out);
/// Returns the chart of save_timeline() in the size and font of a figure.
std::string draw_timeline(const Trace& trace, const base::FigureStyle& style);

}  // namespace observe
