#pragma once
// A trace: timed actions of every processor and link direction, and its file formats.
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace observe {

/// Times are simulated seconds, at least 0, within the window. Numbers of processors, processes,
/// links and channels are indices into the vectors here.
struct Trace {
  /// Activity of a processor during a span; between spans it is idle.
  enum class Doing : std::uint8_t { high, low, switching };
  struct Process {
    std::string name;
    std::uint32_t processor;
  };
  struct Link {  ///< a direction, by processors
    std::uint32_t from, to;
  };
  /// Spans of one processor do not overlap; `process` is meaningless in a switch.
  struct Span {
    double from_s, to_s;
    std::uint32_t processor, process;
    Doing doing;
  };
  /// Transfers on one link do not overlap.
  struct Transfer {
    double from_s, to_s;
    std::uint32_t link, channel;
    std::uint64_t bytes;
  };
  std::vector<std::string> processors, channels;  ///< names, in UTF-8
  std::vector<Process> processes;
  std::vector<Link> links;
  std::vector<Span> spans;          ///< in any order across processors, by time within one
  std::vector<Transfer> transfers;  ///< the same for links
  double begin_s = 0, end_s = 0;    ///< the window
  std::string title;
};

// Three formats; the first two store whole nanoseconds. All throw base::InvariantBroken, before any
// output, for a trace that violates the description above.

/// Trace Event Format (JSON), for Perfetto and chrome://tracing. A processor is a process there,
/// with one track for its CPU and one for every outgoing link direction. An arrow leads from a
/// message on its link to the receiving CPU's next action.
void save_chrome(const Trace& trace, std::ostream& out);

/// Paje, for ViTE and pj_dump: states of CPUs and link directions, and messages as arrows between
/// CPUs. Paje has no escapes. In names, quotation marks therefore become apostrophes, backslashes
/// slashes, and control characters spaces; an empty name becomes "-".
void save_paje(const Trace& trace, std::ostream& out);

/// Gantt chart, SVG: a row for every CPU, and below it thin rows for its outgoing link directions
/// with traffic. If a pixel's time has several activities, heights are their shares. Processors
/// beyond 64 are counted but not drawn.
void save_timeline(const Trace& trace, std::ostream& out);

}  // namespace observe
