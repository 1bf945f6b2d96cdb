// Activities that an observer of random machines receives: they must add up to the counts.
#include <gtest/gtest.h>

#include "tests/simulator/machine/bursts.hpp"
#include "tests/simulator/machine/random_machine.hpp"

namespace occam {
namespace {

using machine::LinkDirection;
using machine::Observer;
using machine::Seconds;

constexpr double HAIR_S = 1e-12;  // tolerance in seconds

struct Span {
  double from, to;
};

struct Recorder : Observer {
  struct Cpu {
    std::vector<Span> spans;
    double high = 0, low = 0, switching = 0;
    std::vector<std::string> names;
  };
  struct Link {
    std::vector<Span> spans;
    double busy = 0;
    std::uint64_t messages = 0, bytes = 0;
  };
  std::map<const Processor*, Cpu> cpus;
  std::map<const LinkDirection*, Link> links;
  std::string wrong;

  void name_process(const Processor& on, std::uint32_t id, const std::string& name) override {
    if (id != cpus[&on].names.size()) wrong += "names are not dense\n";
    cpus[&on].names.push_back(name);
  }
  void ran(const Processor& on, std::uint32_t id, Doing doing, Seconds from, Seconds to) override {
    Cpu& cpu = cpus[&on];
    if (id >= cpu.names.size()) wrong += "an id without a name\n";
    if (to <= from) wrong += "an empty span\n";
    cpu.spans.push_back({from.value, to.value});
    const double length = (to - from).value;
    (doing == Doing::high ? cpu.high : doing == Doing::low ? cpu.low : cpu.switching) += length;
  }
  void moved(const LinkDirection& link, const std::string& channel, std::uint64_t bytes,
             Seconds from, Seconds to) override {
    if (channel.empty()) wrong += "a transfer of no channel\n";
    links[&link].spans.push_back({from.value, to.value});
    links[&link].busy += (to - from).value;
    ++links[&link].messages;
    links[&link].bytes += bytes;
  }
};

std::string check_apart(std::vector<Span> spans, const std::string& who, double end) {
  std::ranges::sort(spans, {}, &Span::from);
  for (std::size_t i = 1; i < spans.size(); ++i)
    if (spans[i].from < spans[i - 1].to - HAIR_S)
      return fmt::format("{}: {} to {} overlaps {}\n", who, spans[i - 1].from, spans[i - 1].to,
                         spans[i].from);
  if (!spans.empty() && spans.back().to > end + HAIR_S) return who + ": a span after the end\n";
  return "";
}

std::string check(Recorder& seen, const machine::Machine& machine) {
  std::string wrong = seen.wrong;
  const double end = machine.now().value;
  const auto differ = [&](const std::string& who, const char* what, double found, double counted) {
    if (std::abs(found - counted) > 1e-9 * (1e-3 + counted))
      wrong += fmt::format("{}: {} {}, counted {}\n", who, what, found, counted);
  };
  for (const auto& cpu : machine.processors()) {
    const auto& told = seen.cpus[cpu.get()];
    const auto use = cpu->use();
    wrong += check_apart(told.spans, cpu->name(), end);
    differ(cpu->name(), "low", told.low, use.busy_low.value);
    differ(cpu->name(), "high and switching", told.high + told.switching, use.busy_high.value);
  }
  for (const auto& link : machine.links()) {
    const auto& told = seen.links[link.get()];
    const auto use = link->use();
    wrong += check_apart(told.spans, link->name(), end);
    differ(link->name(), "busy", told.busy, use.busy.value);
    if (told.bytes != use.bytes || told.messages != use.messages)
      wrong += link->name() + ": other messages were told than were counted\n";
  }
  return wrong;
}

std::string run(const Plan& plan, const Model& model, bool observed, std::string& wrong) {
  Lab lab(model, machine::Code::compiled);
  Recorder recorder;
  build_machine(lab, plan);
  std::deque<std::string> logs;
  for (const Stream& stream : plan.streams) start_stream(lab, stream, logs.emplace_back(), wrong);
  if (observed) lab.machine.set_observer(&recorder);
  lab.machine.run();
  if (observed) wrong += check(recorder, lab.machine);
  std::string text = fmt::format("{:a}\n", lab.machine.now().value);
  for (const auto& log : logs) text += log + "\n";
  for (const auto& cpu : lab.machine.processors())
    text += fmt::format("{:a} ", lab.busy_cycles(*cpu));
  return text;
}

TEST(Observer, SpansDoNotOverlapAndAddUpToWhatIsCounted) {
  for (std::uint64_t seed = 300; seed < 330; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Plan plan = make_plan(seed);
    for (const Model& model : {make_exact_model(), machine::load_model("t805-25")})
      EXPECT_EQ(isolated([&] {
                  std::string wrong;
                  run(plan, model, true, wrong);
                  return wrong;
                }),
                "");
  }
}

TEST(Observer, ChangesNothing) {
  const Model model = machine::load_model("t805-25");
  for (std::uint64_t seed = 300; seed < 310; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Plan plan = make_plan(seed);
    const auto text = [&](bool observed) {
      return isolated([&] {
        std::string wrong;
        return run(plan, model, observed, wrong);
      });
    };
    EXPECT_EQ(text(true), text(false));
  }
}

// Several low-priority processes share the CPU by time slices, and some switches are cut short.
TEST(Observer, SwitchesAndSlicesAddUpToo) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Load load = make_load(seed);
    EXPECT_EQ(isolated([&] {
                Lab lab;
                Recorder recorder;
                Recorded recorded;
                Processor& cpu = lab.cpu();
                start_load(lab, cpu, load, recorded);
                for (auto i = seed % 3; i > 0; --i)
                  cpu.start("other", Priority::low, [&] { compute(load.low); });
                lab.machine.set_observer(&recorder);
                lab.machine.run();
                return check(recorder, lab.machine);
              }),
              "");
  }
}

// The time limit ends the run in the middle of activities. These must be reported up to the limit.
TEST(Observer, IsToldUpToTheLimit) {
  for (std::int64_t limit : {1000, 4097, 20'000, 50'001}) {
    SCOPED_TRACE(fmt::format("limit {}", limit));
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const Load load = make_load(seed);
      EXPECT_EQ(isolated([&]() -> std::string {
                  Lab lab;
                  Recorder recorder;
                  Recorded recorded;
                  Processor& cpu = lab.cpu();
                  start_load(lab, cpu, load, recorded);
                  lab.machine.set_observer(&recorder);
                  lab.machine.run(Cycles{limit} / cpu.clock());
                  std::string wrong = recorder.wrong;
                  const auto& told = recorder.cpus[&cpu];
                  wrong += check_apart(told.spans, "cpu 0", lab.machine.now().value);
                  const double low = told.low * cpu.clock().value,
                               counted = cpu.use().busy_low.value * cpu.clock().value;
                  if (std::abs(low - counted) > 1e-6)
                    wrong += fmt::format("told {} low cycles, counted {}\n", low, counted);
                  return wrong;
                }),
                "");
    }
  }
}

}  // namespace
}  // namespace occam
