// Writes the Trace Event Format. In its events, "X" is a slice (an activity), "s" and "f" are the
// two ends of an arrow, and "M" is a name or a sort index. Times are in microseconds.
#include <map>
#include <utility>

#include "simulator/observe/trace_output.hpp"

namespace observe {

namespace {

std::string quote_json(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      quoted += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      quoted += c;
  }
  return quoted + '"';
}

// Numbers of processes and tracks in the file. The CPU's track has the same number as the process
// that stands for its processor; viewers therefore show this track first.
struct Numbers {
  std::size_t processors;
  std::size_t processor(std::size_t i) const { return i + 1; }
  std::size_t cpu(std::size_t i) const { return i + 1; }
  std::size_t window() const { return processors + 1; }
  std::size_t link(std::size_t i) const { return processors + 2 + i; }
};

class ChromeFile {
 public:
  ChromeFile(const Trace& trace, std::ostream& out)
      : trace_(trace), numbers_{trace.processors.size()}, out_(out) {}

  void write() {
    out_.print(FMT_COMPILE("{{\"displayTimeUnit\":\"ns\",\"traceEvents\":[\n"));
    write_names();
    // Transfers come first, because in this format an arrow ends at the next slice in the file.
    write_transfers();
    write_spans();
    out_.print(FMT_COMPILE("\n]}}\n"));
    out_.flush();
  }

 private:
  void name_process(std::size_t pid, std::size_t place, const std::string& name) {
    out_.print(FMT_COMPILE("{{\"ph\":\"M\",\"pid\":{},\"name\":\"process_name\",\"args\":"
                           "{{\"name\":{}}}}},\n"
                           "{{\"ph\":\"M\",\"pid\":{},\"name\":\"process_sort_index\",\"args\":"
                           "{{\"sort_index\":{}}}}},\n"),
               pid, quote_json(name), pid, place);
  }

  void name_track(std::size_t pid, std::size_t tid, const std::string& name) {
    out_.print(FMT_COMPILE("{{\"ph\":\"M\",\"pid\":{},\"tid\":{},\"name\":\"thread_name\","
                           "\"args\":{{\"name\":{}}}}},\n"
                           "{{\"ph\":\"M\",\"pid\":{},\"tid\":{},\"name\":\"thread_sort_index\","
                           "\"args\":{{\"sort_index\":{}}}}},\n"),
               pid, tid, quote_json(name), pid, tid, tid);
  }

  // Writes the names. Also writes a slice as long as the whole trace, so that viewers show idle
  // time at both ends.
  void write_names() {
    for (std::size_t i = 0; i < trace_.processors.size(); ++i) {
      name_process(numbers_.processor(i), i + 1, trace_.processors[i]);
      name_track(numbers_.processor(i), numbers_.cpu(i), "CPU");
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> between;
    for (std::size_t i = 0; i < trace_.links.size(); ++i) {
      const auto [from, to] = trace_.links[i];
      const int number = ++between[{from, to}];
      name_track(
          numbers_.processor(from), numbers_.link(i),
          "link to " + trace_.processors[to] + (number == 1 ? "" : fmt::format(" ({})", number)));
    }
    const auto title = trace_.title.empty() ? "run" : trace_.title;
    name_process(numbers_.window(), 0, title);
    name_track(numbers_.window(), numbers_.window(), "window");
    write_slice(numbers_.window(), numbers_.window(), trace_.begin_s, trace_.end_s);
    out_.print(FMT_COMPILE(",\"name\":{},\"cat\":\"window\"}}"), quote_json(title));
  }

  // Writes a slice without its closing brace.
  void write_slice(std::size_t pid, std::size_t tid, double from_s, double to_s) {
    const auto from = to_nanoseconds(from_s), length = to_nanoseconds(to_s) - from;
    out_.print(FMT_COMPILE("{{\"ph\":\"X\",\"pid\":{},\"tid\":{},\"ts\":{}.{:03},\"dur\":{}.{:03}"),
               pid, tid, from / 1000, from % 1000, length / 1000, length % 1000);
  }

  void write_transfers() {
    std::vector<std::string> channels;
    for (const auto& name : trace_.channels) channels.push_back(quote_json(name));
    for (std::size_t i = 0; i < trace_.transfers.size(); ++i) {
      const auto& transfer = trace_.transfers[i];
      const auto& link = trace_.links[transfer.link];
      out_.print(FMT_COMPILE(",\n"));
      write_slice(numbers_.processor(link.from), numbers_.link(transfer.link), transfer.from_s,
                  transfer.to_s);
      out_.print(FMT_COMPILE(",\"name\":{},\"cat\":\"link\",\"args\":{{\"bytes\":{}}}}}"),
                 channels[transfer.channel], transfer.bytes);
      write_arrow_end('s', i, numbers_.processor(link.from), numbers_.link(transfer.link),
                      transfer.from_s);
      write_arrow_end('f', i, numbers_.processor(link.to), numbers_.cpu(link.to), transfer.to_s);
    }
  }

  void write_arrow_end(char end, std::size_t id, std::size_t pid, std::size_t tid, double time_s) {
    const auto time = to_nanoseconds(time_s);
    out_.print(FMT_COMPILE(",\n{{\"ph\":\"{}\",\"id\":{},\"pid\":{},\"tid\":{},\"ts\":{}.{:03},"
                           "\"name\":\"message\",\"cat\":\"message\"}}"),
               end, id, pid, tid, time / 1000, time % 1000);
  }

  void write_spans() {
    const std::string switching = "\"switching\",\"cat\":\"switching\",\"cname\":\"grey\"";
    std::vector<std::string> high, low;  // for each process, the text that ends its slices
    for (const auto& process : trace_.processes) {
      high.push_back(quote_json(process.name) + ",\"cat\":\"high\",\"cname\":\"bad\"");
      low.push_back(quote_json(process.name) + ",\"cat\":\"low\",\"cname\":\"good\"");
    }
    for (const auto& span : trace_.spans) {
      const auto& end = span.doing == Trace::Doing::switching ? switching
                        : span.doing == Trace::Doing::high    ? high[span.process]
                                                              : low[span.process];
      out_.print(FMT_COMPILE(",\n"));
      write_slice(numbers_.processor(span.processor), numbers_.cpu(span.processor), span.from_s,
                  span.to_s);
      out_.print(FMT_COMPILE(",\"name\":{}}}"), end);
    }
  }

  const Trace& trace_;
  Numbers numbers_;
  TraceOutput out_;
};

}  // namespace

void save_chrome(const Trace& trace, std::ostream& out) {
  check(trace);
  ChromeFile(trace, out).write();
}

}  // namespace observe
