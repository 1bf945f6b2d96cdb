#pragma once
// A trace: what every processor and link direction did, and when; and the files that show it.
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace observe {

/// Times are simulated seconds, at least 0, within the window. Numbers of processors, processes,
/// links and channels are indices into the vectors here.
struct Trace {
  /// What a processor does; between that it is idle.
  enum class Doing : std::uint8_t { high, low, switching };
  struct Process {
    std::string name;
    std::uint32_t processor;
  };
  struct Link {  ///< a direction, by processors
    std::uint32_t from, to;
  };
  /// Spans of one processor do not overlap; `process` means nothing in a switch.
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

// Three files of the same trace; the first two keep whole nanoseconds. All throw
// base::InvariantBroken, before they write, for a trace that is not as described above.

/// Trace Event Format (JSON), for Perfetto and chrome://tracing. A processor is a process there,
/// with a track for its CPU and one for every direction that leaves it; an arrow leads from a
/// message on its link to what the receiving CPU does next.
void save_chrome(const Trace& trace, std::ostream& out);

/// Paje, for ViTE and pj_dump: states of CPUs and link directions, and messages as arrows from CPU
/// to CPU. Paje has no escapes: in names, quotation marks become apostrophes, backslashes slashes
/// and control characters spaces; an empty name becomes "-".
void save_paje(const Trace& trace, std::ostream& out);

/// A Gantt chart, SVG: a row for every CPU, and below it thin ones for the directions that leave it
/// and carried anything. Where a pixel's time holds more than one thing, heights are shares of it.
/// Processors beyond 64 are not drawn, but counted.
void save_timeline(const Trace& trace, std::ostream& out);

}  // namespace observe
