// Writes Paje: first definitions of kinds of events, then the events sorted by time, one per line.
#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "simulator/observe/trace_output.hpp"

namespace observe {

namespace {

// Definition of a kind of event. The number of a kind is its index in EVENTS. Only fields that both
// ViTE and PajeNG know are used. A CPU or link changes its state by an event PajeSetState. This
// event has number 4 for idle, quiet and switching, and number 5 or 6 for states with additional
// fields.
struct EventDef {
  const char* name;
  std::vector<std::string_view> fields;
};
const EventDef EVENTS[] = {
    {"DefineContainerType", {"Alias", "Type", "Name"}},
    {"DefineStateType", {"Alias", "Type", "Name"}},
    {"DefineLinkType", {"Alias", "Type", "StartContainerType", "EndContainerType", "Name"}},
    {"DefineEntityValue", {"Alias", "Type", "Name", "Color"}},
    {"SetState", {"Time", "Type", "Container", "Value"}},
    {"SetState", {"Time", "Type", "Container", "Value", "Process"}},
    {"SetState", {"Time", "Type", "Container", "Value", "Channel", "Bytes"}},
    {"StartLink", {"Time", "Type", "Container", "StartContainer", "Value", "Key"}},
    {"EndLink", {"Time", "Type", "Container", "EndContainer", "Value", "Key"}},
    {"CreateContainer", {"Time", "Alias", "Type", "Container", "Name"}},
    {"DestroyContainer", {"Time", "Type", "Name"}},
};

constexpr std::string_view TYPES = R"(0 Machine 0 "machine"
0 Processor Machine "processor"
0 Cpu Processor "cpu"
0 Link Processor "link direction"
1 Doing Cpu "cpu"
1 Carrying Link "link"
2 Message Machine Cpu Cpu "message"
3 high Doing "high priority" "0.90 0.33 0.05"
3 low Doing "low priority" "0.62 0.79 0.88"
3 switching Doing "switching" "0.25 0.25 0.25"
3 idle Doing "idle" "0.80 0.80 0.80"
3 busy Carrying "message" "0.25 0.67 0.36"
3 quiet Carrying "quiet" "0.80 0.80 0.80"
)";

std::string make_header() {
  std::string text;
  for (const EventDef& event : EVENTS) {
    text += fmt::format("%EventDef Paje{} {}\n", event.name, &event - EVENTS);
    for (const auto field : event.fields)
      text += fmt::format("% {} {}\n", field,
                          field == "Time"    ? "date"
                          : field == "Color" ? "color"
                                             : "string");
    text += "%EndEventDef\n";
  }
  return text.append(TYPES);
}

std::string quote_paje(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text.empty() ? "-" : text) {  // PajeNG cannot read an empty name
    const auto code = static_cast<unsigned char>(c);
    quoted += c == '"' ? '\'' : c == '\\' ? '/' : code < 0x20 || code == 0x7f ? ' ' : c;
  }
  return quoted + '"';
}

std::vector<std::string> quote_all(const std::vector<std::string>& names) {
  std::vector<std::string> quoted;
  for (const auto& name : names) quoted.push_back(quote_paje(name));
  return quoted;
}

class PajeFile {
 public:
  PajeFile(const Trace& trace, std::ostream& out)
      : trace_(trace), channels_(quote_all(trace.channels)), out_(out) {
    for (const auto& process : trace.processes) processes_.push_back(quote_paje(process.name));
  }

  void write() {
    out_.print(FMT_COMPILE("{}"), make_header());
    pass_to(to_nanoseconds(trace_.begin_s));
    create_containers();
    write_events();
    pass_to(to_nanoseconds(trace_.end_s));
    destroy_containers();
    out_.flush();
  }

 private:
  // The spans of a processor, or the transfers on a link. `past` counts their starts and ends
  // written so far.
  struct Lane {
    std::vector<std::uint32_t> items;
    std::size_t past = 0;
  };

  void pass_to(std::int64_t time) { now_ = std::max(now_, time); }

  // Writes the start of a line: number of the event's kind, and time in seconds.
  void begin(int event) {
    constexpr std::int64_t giga = 1'000'000'000;
    out_.print(FMT_COMPILE("{} {}.{:09} "), event, now_ / giga, now_ % giga);
  }

  void create_containers() {
    begin(9);
    out_.print(FMT_COMPILE("m Machine 0 {}\n"),
               quote_paje(trace_.title.empty() ? "run" : trace_.title));
    for (std::size_t i = 0; i < trace_.processors.size(); ++i) {
      begin(9);
      out_.print(FMT_COMPILE("p{} Processor m {}\n"), i, quote_paje(trace_.processors[i]));
      begin(9);
      out_.print(FMT_COMPILE("c{} Cpu p{} {}\n"), i, i,
                 quote_paje("CPU of " + trace_.processors[i]));
      rest(i, "idle");
    }
    for (std::size_t i = 0; i < trace_.links.size(); ++i) {
      const auto [from, to] = trace_.links[i];
      begin(9);
      out_.print(FMT_COMPILE("l{} Link p{} {}\n"), i, from,
                 quote_paje("to " + trace_.processors[to] + " from " + trace_.processors[from]));
      rest(trace_.processors.size() + i, "quiet");
    }
  }

  void destroy_containers() {
    for (std::size_t i = 0; i < trace_.links.size(); ++i) destroy("Link", 'l', i);
    for (std::size_t i = 0; i < trace_.processors.size(); ++i) {
      destroy("Cpu", 'c', i);
      destroy("Processor", 'p', i);
    }
    begin(10);
    out_.print(FMT_COMPILE("Machine m\n"));
  }

  void destroy(const char* type, char letter, std::size_t i) {
    begin(10);
    out_.print(FMT_COMPILE("{} {}{}\n"), type, letter, i);
  }

  // Merges the events of all lanes (processors and links) by time.
  void write_events() {
    lanes_.resize(trace_.processors.size() + trace_.links.size());
    for (std::uint32_t i = 0; i < trace_.spans.size(); ++i)
      lanes_[trace_.spans[i].processor].items.push_back(i);
    for (std::uint32_t i = 0; i < trace_.transfers.size(); ++i)
      lanes_[trace_.processors.size() + trace_.transfers[i].link].items.push_back(i);
    using Next = std::pair<std::int64_t, std::size_t>;  // time and lane
    std::priority_queue<Next, std::vector<Next>, std::greater<>> next;
    const auto push = [&](std::size_t lane) {
      if (lanes_[lane].past < 2 * lanes_[lane].items.size()) next.emplace(time_of(lane), lane);
    };
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) push(lane);
    while (!next.empty()) {
      const auto [time, lane] = next.top();
      next.pop();
      pass_to(time);
      write_event(lane);
      push(lane);
    }
  }

  bool is_cpu(std::size_t lane) const { return lane < trace_.processors.size(); }

  // Time of the lane's next event, which is the start or the end of an item.
  std::int64_t time_of(std::size_t lane) const {
    const auto& [items, past] = lanes_[lane];
    const auto time = [&](const auto& item) { return past % 2 ? item.to_s : item.from_s; };
    const auto item = items[past / 2];
    return to_nanoseconds(is_cpu(lane) ? time(trace_.spans[item]) : time(trace_.transfers[item]));
  }

  void write_event(std::size_t lane) {
    auto& [items, past] = lanes_[lane];
    const auto item = items[past / 2];
    const bool is_start = past++ % 2 == 0;
    if (is_start)
      is_cpu(lane) ? start_span(trace_.spans[item]) : start_transfer(item);
    else if (!is_cpu(lane))
      end_transfer(item);
    const bool is_last = past == 2 * items.size();
    if (!is_start && (is_last || time_of(lane) > now_)) rest(lane, is_cpu(lane) ? "idle" : "quiet");
  }

  void rest(std::size_t lane, const char* value) {
    begin(4);
    if (is_cpu(lane))
      out_.print(FMT_COMPILE("Doing c{} {}\n"), lane, value);
    else
      out_.print(FMT_COMPILE("Carrying l{} {}\n"), lane - trace_.processors.size(), value);
  }

  void start_span(const Trace::Span& span) {
    if (span.doing == Trace::Doing::switching) return rest(span.processor, "switching");
    begin(5);
    out_.print(FMT_COMPILE("Doing c{} {} {}\n"), span.processor,
               span.doing == Trace::Doing::high ? "high" : "low", processes_[span.process]);
  }

  void start_transfer(std::uint32_t i) {
    const auto& transfer = trace_.transfers[i];
    begin(6);
    out_.print(FMT_COMPILE("Carrying l{} busy {} {}\n"), transfer.link, channels_[transfer.channel],
               transfer.bytes);
    begin(7);
    out_.print(FMT_COMPILE("Message m c{} {} {}\n"), trace_.links[transfer.link].from,
               channels_[transfer.channel], i);
  }

  void end_transfer(std::uint32_t i) {
    begin(8);
    const auto& transfer = trace_.transfers[i];
    out_.print(FMT_COMPILE("Message m c{} {} {}\n"), trace_.links[transfer.link].to,
               channels_[transfer.channel], i);
  }

  const Trace& trace_;
  std::vector<std::string> channels_, processes_;  // names as quoted strings
  TraceOutput out_;
  std::vector<Lane> lanes_;
  std::int64_t now_ = 0;  // time of the last line written, in ns
};

}  // namespace

void save_paje(const Trace& trace, std::ostream& out) {
  check(trace);
  PajeFile(trace, out).write();
}

}  // namespace observe
