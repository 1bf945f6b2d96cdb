// Traces in the Trace Event Format, as a JSON parser reads them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/errors.hpp"
#include "tests/simulator/observe/trace_support.hpp"

namespace observe {
namespace {

using nlohmann::json;

struct Events {
  std::map<std::string, std::vector<json>> by_category;
  // names of processes and tracks; the keys are like "process_name 1 1"
  std::map<std::string, json> names;
};

Events read(const std::string& text) {
  Events events;
  const auto file = json::parse(text);
  for (const auto& event : file.at("traceEvents"))
    if (event.at("ph") == "M")
      events.names[fmt::format("{} {} {}", event.at("name").get<std::string>(),
                               event.at("pid").get<int>(), event.value("tid", 0))] =
          event.at("args");
    else
      events.by_category[event.at("cat")].push_back(event);
  return events;
}

// Compares times with the resolution of the file, one nanosecond.
void expect_times(const json& event, double from_s, double to_s) {
  EXPECT_EQ(std::llround(event.at("ts").get<double>() * 1e3), std::llround(from_s * 1e9));
  EXPECT_EQ(std::llround(event.at("dur").get<double>() * 1e3),
            std::llround(to_s * 1e9) - std::llround(from_s * 1e9));
}

TEST(TraceChrome, SavesWholeNanoseconds) {
  const auto text = saved(save_chrome, make_small_trace());
  for (
      const char* line :
      {R"({"ph":"X","pid":1,"tid":1,"ts":0.000,"dur":1000.000,"name":"give","cat":"low","cname":"good"},)",
       R"({"ph":"X","pid":2,"tid":2,"ts":4000.000,"dur":123.457,"name":"switching","cat":"switching","cname":"grey"},)",
       R"({"ph":"X","pid":1,"tid":4,"ts":1000.000,"dur":3000.000,"name":"task","cat":"link","args":{"bytes":80}},)",
       R"({"ph":"s","id":0,"pid":1,"tid":4,"ts":1000.000,"name":"message","cat":"message"},)",
       R"({"ph":"f","id":0,"pid":2,"tid":2,"ts":4000.000,"name":"message","cat":"message"},)"})
    EXPECT_NE(text.find(line), std::string::npos) << line;
}

TEST(TraceChrome, NamesProcessorsInOrderAndTheirTracks) {
  auto names = read(saved(save_chrome, make_small_trace())).names;
  EXPECT_EQ(names["process_name 1 0"]["name"], "farmer");
  EXPECT_EQ(names["process_name 2 0"]["name"], "worker");
  EXPECT_EQ(names["process_name 3 0"]["name"], "small");
  EXPECT_EQ(names["process_sort_index 3 0"]["sort_index"], 0);
  EXPECT_EQ(names["process_sort_index 1 0"]["sort_index"], 1);
  EXPECT_EQ(names["thread_name 1 1"]["name"], "CPU");
  EXPECT_EQ(names["thread_name 1 4"]["name"], "link to worker");
  EXPECT_EQ(names["thread_name 2 5"]["name"], "link to farmer");
}

// The spans of a category appear in the order of the trace, and so do the transfers.
TEST(TraceChrome, HoldsEverySpanAndTransferOnce) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Trace trace = make_random_trace(seed);
    Events events = read(saved(save_chrome, trace));
    std::map<std::string, std::size_t> next;
    for (const auto& span : trace.spans) {
      const std::string categories[] = {"high", "low", "switching"};
      const auto& category = categories[static_cast<std::size_t>(span.doing)];
      ASSERT_LT(next[category], events.by_category[category].size());
      const auto& event = events.by_category[category][next[category]++];
      expect_times(event, span.from_s, span.to_s);
      EXPECT_EQ(event.at("pid"), span.processor + 1);
      EXPECT_EQ(event.at("name"),
                category == "switching" ? "switching" : trace.processes[span.process].name);
    }
    for (const auto& [category, used] : next)
      EXPECT_EQ(used, events.by_category[category].size()) << category;
    const auto& messages = events.by_category["link"];
    const auto& arrows = events.by_category["message"];
    ASSERT_EQ(messages.size(), trace.transfers.size());
    ASSERT_EQ(arrows.size(), 2 * messages.size());
    for (std::size_t i = 0; i < messages.size(); ++i) {
      const auto& transfer = trace.transfers[i];
      expect_times(messages[i], transfer.from_s, transfer.to_s);
      EXPECT_EQ(messages[i].at("name"), trace.channels[transfer.channel]);
      EXPECT_EQ(messages[i].at("args").at("bytes"), transfer.bytes);
      EXPECT_EQ(arrows[2 * i].at("tid"), messages[i].at("tid"));
      EXPECT_EQ(arrows[2 * i + 1].at("pid"), trace.links[transfer.link].to + 1);
    }
    ASSERT_EQ(events.by_category["window"].size(), 1u);
    expect_times(events.by_category["window"][0], trace.begin_s, trace.end_s);
  }
}

TEST(TraceChrome, SavesAnEmptyTrace) {
  const auto events = read(saved(save_chrome, {}));
  EXPECT_EQ(events.by_category.size(), 1u);
}

TEST(Trace, MustHoldWhatItPromises) {
  const auto expect_broken = [](const auto& spoil) {
    Trace trace = make_small_trace();
    spoil(trace);
    for (const auto save : {save_chrome, save_paje, save_timeline})
      EXPECT_THROW(saved(save, trace), base::InvariantBroken);
  };
  expect_broken([](Trace& t) { t.spans[0].processor = 2; });
  expect_broken([](Trace& t) { t.spans[0].process = 2; });
  expect_broken([](Trace& t) { t.processes[0].processor = 2; });
  expect_broken([](Trace& t) { t.links[0].to = 2; });
  expect_broken([](Trace& t) { t.transfers[0].link = 2; });
  expect_broken([](Trace& t) { t.transfers[0].channel = 1; });
  expect_broken([](Trace& t) { t.spans[0].to_s = -1; });
  expect_broken([](Trace& t) { std::swap(t.spans[1], t.spans[2]); });
  expect_broken([](Trace& t) { t.spans[2].from_s = 0.0041; });
  expect_broken([](Trace& t) { t.transfers.push_back(t.transfers[0]); });
}

}  // namespace
}  // namespace observe
