// Random machines with random cuts of links and stops of processors. No message may be received
// twice. A message between running processors must be received, or its sender must notice the
// failure. The run must end, and must repeat to the last bit.
#include <gtest/gtest.h>

#include <set>

#include "simulator/observe/use.hpp"
#include "tests/simulator/machine/failing_links.hpp"
#include "tests/simulator/machine/random_machine.hpp"

namespace occam {
namespace {

// Messages in one direction of a link. For each message: whether the output succeeded, and how
// often it was received.
struct Record {
  int from, to;
  std::unique_ptr<Channel<Words>> channel;
  std::vector<int> sent, received;
};
constexpr int UNKNOWN = -1;

struct Traffic {
  Priority writer, reader;
  bool by_alt;
  std::int64_t writes, reads;  // cycles of computation for each message
  std::uint64_t longest;
};

void write_all(const Traffic& t, Record& record) {
  for (std::size_t n = 0; n < record.sent.size(); ++n) {
    compute(t.writes);
    record.sent[n] = out_or_fail(*record.channel, {n * 37 % t.longest, n});
    // a process that does not return here tries the next message
    if (record.sent[n] == 0 && n % 3 == 0) return;
  }
}

// Takes each message by an input, or by an ALT with a timeout, until the link fails.
void read_all(const Traffic& t, Record& record) {
  std::int64_t patience = 4;
  for (std::size_t n = 0; n < record.received.size();) {
    std::optional<Words> got;
    bool late = false;
    if (t.by_alt)
      pri_alt(when(*record.channel, got, [] {}),
              after(read_timer() + (patience *= 2), [&] { late = true; }));
    else
      got = in_or_fail(*record.channel);
    if (late && !record.channel->cut()) continue;
    if (!got) return;
    ++record.received.at(got->content);
    compute(t.reads);
    ++n;
  }
}

struct Chaos {
  Lab lab;
  topologies::Topology topology;
  std::deque<Record> records;
  std::deque<Traffic> traffic;
  std::mt19937_64 random;

  Chaos(std::uint64_t seed, const Model& model) : lab(model), random(seed) {
    Plan plan = make_plan(seed);
    build_machine(lab, plan);
    topology = plan.topology;
    for (const auto& link : topology.links)
      for (bool forward : {true, false})
        start(forward ? link.a.processor : link.b.processor,
              forward ? link.b.processor : link.a.processor);
  }
  Processor& cpu(int i) { return *lab.machine.processors()[i]; }
  std::int64_t pick(std::int64_t n) { return static_cast<std::int64_t>(random() % n); }

  void start(int from, int to) {
    auto& link = lab.machine.link(cpu(from), cpu(to));
    const std::size_t n = 1 + pick(20);
    Record& record = records.emplace_back(
        Record{from, to,
               std::make_unique<Channel<Words>>(
                   link.name(), link, pick(2) == 0 ? Protocol::simple : Protocol::variant),
               std::vector<int>(n, UNKNOWN), std::vector<int>(n, 0)});
    const Traffic& t =
        traffic.emplace_back(Traffic{BOTH_PRIORITIES[pick(2)], BOTH_PRIORITIES[pick(2)],
                                     pick(2) == 0, pick(3000), pick(3000), 1 + random() % 200});
    cpu(from).start("writer", t.writer, [&t, &record] { write_all(t, record); });
    cpu(to).start("reader", t.reader, [&t, &record] { read_all(t, record); });
  }
  void fail(bool stops) {
    const auto date = [&] { return at_cycle(lab, static_cast<double>(pick(8) * pick(10'000))); };
    for (auto n = pick(4); n > 0; --n) {
      const auto& link = topology.links[pick(std::ssize(topology.links))];
      lab.machine.cut_link(cpu(link.a.processor), cpu(link.b.processor), date());
    }
    for (auto n = stops ? 1 + pick(2) : 0; n > 0; --n)
      lab.machine.stop_processor(cpu(static_cast<int>(pick(topology.processors))), date());
  }
  std::string check(const Record& r) {
    const bool from_runs = !cpu(r.from).stopped(), to_runs = !cpu(r.to).stopped();
    std::string wrong;
    for (std::size_t n = 0; n < r.sent.size(); ++n) {
      bool right = r.received[n] <= 1;
      if (r.received[n] == 1) right &= r.sent[n] == 1 || (!from_runs && r.sent[n] == UNKNOWN);
      if (r.received[n] == 0) right &= r.sent[n] != 1 || !to_runs;
      if (!right)
        wrong += fmt::format("{}: message {} was sent {}, received {}\n", r.channel->name(), n,
                             r.sent[n], r.received[n]);
    }
    return wrong;
  }
};

// Runs a machine, and returns its errors and a log of its results.
std::pair<std::string, std::string> run(std::uint64_t seed, const Model& model, bool stops) {
  const auto text = isolated([&] {
    Chaos chaos(seed, model);
    chaos.fail(stops);
    std::string wrong, log;
    int lost = 0;
    if (chaos.lab.machine.run() != machine::End::done) wrong += "did not end\n";
    for (const Record& record : chaos.records) {
      wrong += chaos.check(record);
      lost += static_cast<int>(std::ranges::count(record.sent, 0));
    }
    // Also checks invariants of the counts.
    const auto use = observe::collect(chaos.lab.machine);
    for (const auto& cpu : use.cpus) log += fmt::format("{:a} ", cpu.busy_s);
    for (const auto& link : use.links) log += fmt::format("{:a} {} ", link.busy_s, link.bytes);
    return fmt::format("{}|{}|{} {:a}", wrong, lost, log, use.time_s);
  });
  const auto bar = text.find('|');
  return {text.substr(0, bar), text.substr(bar + 1)};
}

TEST(RandomFailure, EachMessageIsReceivedOnceOrItsSenderIsTold) {
  int with_losses = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const auto model = seed % 2 == 0 ? make_stealing_model() : machine::load_model("t805-25");
    const auto [wrong, log] = run(seed, model, seed % 3 == 0);
    EXPECT_EQ(wrong, "");
    with_losses += log.starts_with("0|") ? 0 : 1;
  }
  EXPECT_GT(with_losses, 60);
}

TEST(RandomFailure, RepeatsItselfToTheLastBit) {
  for (std::uint64_t seed = 200; seed < 212; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const auto model = machine::load_model("t805-25");
    EXPECT_EQ(run(seed, model, seed % 2 == 0), run(seed, model, seed % 2 == 0));
  }
}

}  // namespace
}  // namespace occam
