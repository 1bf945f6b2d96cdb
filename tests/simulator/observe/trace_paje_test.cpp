// Traces in the Paje format, read back according to the definitions in their own headers.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "tests/simulator/observe/trace_support.hpp"

namespace observe {
namespace {

struct Event {
  std::string kind;
  std::map<std::string, std::string> fields;
  std::string at(const std::string& field) const {
    const auto found = fields.find(field);
    return found == fields.end() ? "(none)" : found->second;
  }
  double time_s() const { return fields.contains("Time") ? std::stod(at("Time")) : 0; }
};

// Splits a line into words. A quoted text counts as one word and keeps its quotation marks.
std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < line.size();) {
    const auto end = line[at] == '"' ? line.find('"', at + 1) + 1 : line.find(' ', at);
    words.push_back(line.substr(at, end == std::string::npos ? end : end - at));
    at = line.find_first_not_of(' ', std::min(end, line.size()));
  }
  return words;
}

std::vector<Event> read(const std::string& text) {
  std::map<std::string, std::pair<std::string, std::vector<std::string>>> definitions;
  std::vector<Event> events;
  std::istringstream in(text);
  std::string open;
  for (std::string line; std::getline(in, line);) {
    const auto words = split(line);
    if (words.at(0) == "%EventDef") {
      open = words.at(2);
      definitions[open].first = words.at(1);
    } else if (words.at(0) == "%") {
      definitions[open].second.push_back(words.at(1));
    } else if (words.at(0) != "%EndEventDef") {
      const auto& [kind, fields] = definitions.at(words[0]);
      EXPECT_EQ(words.size(), fields.size() + 1) << line;
      events.push_back({kind, {}});
      for (std::size_t i = 0; i < fields.size(); ++i)
        events.back().fields[fields[i]] = words.at(i + 1);
    }
  }
  return events;
}

// The state of a viewer while it reads a trace. Checks what must hold for every trace.
struct Viewer {
  std::set<std::string> types, values, containers;
  // By container: the present value, and the time at which it began.
  std::map<std::string, std::pair<std::string, double>> states;
  // Total time in seconds, by container and value.
  std::map<std::string, std::map<std::string, double>> totals;
  std::map<std::string, Event> arrows;  // arrows that have begun but not ended, by key
  double now_s = 0;

  void read(const Event& event) {
    EXPECT_GE(event.kind.starts_with("PajeDefine") ? now_s : event.time_s(), now_s);
    now_s = std::max(now_s, event.time_s());
    if (event.kind == "PajeDefineEntityValue") {
      EXPECT_TRUE(types.contains(event.at("Type")));
      values.insert(event.at("Alias"));
    } else if (event.kind.starts_with("PajeDefine")) {
      EXPECT_TRUE(event.at("Type") == "0" || types.contains(event.at("Type")));
      types.insert(event.at("Alias"));
    } else if (event.kind == "PajeCreateContainer") {
      EXPECT_TRUE(event.at("Container") == "0" || containers.contains(event.at("Container")));
      EXPECT_TRUE(containers.insert(event.at("Alias")).second);
    } else if (event.kind == "PajeDestroyContainer") {
      EXPECT_EQ(containers.erase(event.at("Name")), 1u);
    } else {
      EXPECT_TRUE(containers.contains(event.at("Container")));
      if (event.kind == "PajeSetState") set_state(event);
      if (event.kind == "PajeStartLink") start_arrow(event);
      if (event.kind == "PajeEndLink") end_arrow(event);
    }
  }

  void set_state(const Event& event) {
    EXPECT_TRUE(values.contains(event.at("Value")));
    auto& [value, since_s] = states[event.at("Container")];
    totals[event.at("Container")][value] += event.time_s() - since_s;
    value = event.at("Value");
    since_s = event.time_s();
  }

  void start_arrow(const Event& event) {
    EXPECT_TRUE(containers.contains(event.at("StartContainer")));
    EXPECT_TRUE(arrows.emplace(event.at("Key"), event).second);
  }

  void end_arrow(const Event& event) {
    EXPECT_TRUE(containers.contains(event.at("EndContainer")));
    EXPECT_EQ(arrows.erase(event.at("Key")), 1u);
  }
};

TEST(TracePaje, SavesEventsByTime) {
  const auto text = saved(save_paje, make_small_trace());
  EXPECT_EQ(text.substr(text.find("9 0.0")), R"(9 0.000000000 m Machine 0 "small"
9 0.000000000 p0 Processor m "farmer"
9 0.000000000 c0 Cpu p0 "CPU of farmer"
4 0.000000000 Doing c0 idle
9 0.000000000 p1 Processor m "worker"
9 0.000000000 c1 Cpu p1 "CPU of worker"
4 0.000000000 Doing c1 idle
9 0.000000000 l0 Link p0 "to worker from farmer"
4 0.000000000 Carrying l0 quiet
9 0.000000000 l1 Link p1 "to farmer from worker"
4 0.000000000 Carrying l1 quiet
5 0.000000000 Doing c0 low "give"
4 0.001000000 Doing c0 idle
6 0.001000000 Carrying l0 busy "task" 80
7 0.001000000 Message m c0 "task" 0
4 0.004000000 Doing c1 switching
8 0.004000000 Message m c1 "task" 0
4 0.004000000 Carrying l0 quiet
5 0.004123457 Doing c1 high "take"
4 0.010000000 Doing c1 idle
10 0.010000000 Link l0
10 0.010000000 Link l1
10 0.010000000 Cpu c0
10 0.010000000 Processor p0
10 0.010000000 Cpu c1
10 0.010000000 Processor p1
10 0.010000000 Machine m
)");
}

TEST(TracePaje, AddsUpAndEndsEverything) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Trace trace = make_random_trace(seed);
    Viewer viewer;
    for (const auto& event : read(saved(save_paje, trace))) viewer.read(event);
    EXPECT_TRUE(viewer.containers.empty());
    EXPECT_TRUE(viewer.arrows.empty());
    for (const auto& [container, state] : viewer.states)
      EXPECT_EQ(state.first, container[0] == 'c' ? "idle" : "quiet");
    EXPECT_NEAR(viewer.now_s, trace.end_s, 1e-9);
    std::map<std::string, std::map<std::string, double>> totals;
    for (const auto& span : trace.spans) {
      const char* const names[] = {"high", "low", "switching"};
      totals[fmt::format("c{}", span.processor)][names[static_cast<std::size_t>(span.doing)]] +=
          span.to_s - span.from_s;
    }
    for (const auto& transfer : trace.transfers)
      totals[fmt::format("l{}", transfer.link)]["busy"] += transfer.to_s - transfer.from_s;
    for (const auto& [container, by_value] : totals)
      for (const auto& [value, time_s] : by_value)
        EXPECT_NEAR(viewer.totals[container][value], time_s,
                    1e-9 * static_cast<double>(trace.spans.size() + trace.transfers.size()));
  }
}

TEST(TracePaje, SavesAnEmptyTrace) {
  Viewer viewer;
  for (const auto& event : read(saved(save_paje, {}))) viewer.read(event);
  EXPECT_TRUE(viewer.containers.empty());
}

}  // namespace
}  // namespace observe
