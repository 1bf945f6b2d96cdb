// Processes without a stack must behave as those with a stack do, at the same dates.
#include <gtest/gtest.h>

#include <random>

#include "tests/support/lab.hpp"

namespace occam::proc_test {
namespace {

constexpr std::size_t INPUTS = 4;
constexpr std::uint64_t MESSAGES = 6;  // number of messages that each writer sends

struct Writer {
  Channel<Words>& to;
  std::int64_t computes;
  Words message(std::uint64_t m) const { return {4 + 4 * (m % 7), 100 * computes + m}; }

  void with_stack() const {
    for (std::uint64_t m = 0; m < MESSAGES; ++m) {
      compute(computes);
      out(to, message(m));
    }
  }
  Proc without() const {
    for (std::uint64_t m = 0; m < MESSAGES; ++m) {
      compute(computes);
      co_await to.output(message(m));
    }
  }
};

// A PRI ALT. Input 0 has precedence over all other inputs. If `fair`, the other inputs take turns.
struct Reader {
  bool fair;
  std::vector<Channel<Words>*> inputs, rest{inputs.begin() + 1, inputs.end()};
  Numbers seen = {};  // for each message: its content, and the cycle at which it had been input
  std::size_t favourite = 0;
  Words got = {};

  auto first() {
    return when(*inputs[0], got, [this] { note(got); });
  }
  template <bool is_fair>
  auto others() {
    const auto take = [this](std::size_t i, const Words& message) {
      note(message);
      favourite = (i + 1) % rest.size();
    };
    if constexpr (is_fair)
      return fair_each(rest, favourite, take);
    else
      return each(rest, favourite, take);
  }
  auto never() const {
    return otherwise(false, [] {});
  }
  void note(const Words& message) { seen.push_back(static_cast<double>(message.content)); }

  void with_stack() {
    for (std::size_t left = INPUTS * MESSAGES; left > 0; --left) {
      if (fair)
        pri_alt(first(), others<true>(), never());
      else
        pri_alt(first(), others<false>());
      seen.push_back(own_cycles());
    }
  }
  Proc without() {
    for (std::size_t left = INPUTS * MESSAGES; left > 0; --left) {
      if (fair)
        co_await alternative(first(), others<true>(), never());
      else
        co_await alternative(first(), others<false>());
      co_await machine::Sync();
      seen.push_back(own_cycles());
    }
  }
};

enum class Bodies { with_stacks, without, mixed };

void start(Processor& cpu, Priority priority, bool has_stack, auto& body) {
  if (has_stack)
    cpu.start("process", priority, [&body] { body.with_stack(); });
  else
    cpu.start("process", priority, body.without());
}

// Runs writers on the reader's processor, on its companion and on neighbours. A message is sent
// alone, after a tag, or after its size.
Numbers run(std::uint64_t seed, Bodies bodies) {
  std::mt19937_64 random(seed);
  return isolated_numbers([&] {
    Lab lab(machine::load_model("t805-25"), machine::Code::compiled);
    Processor& cpu = lab.cpu();
    std::deque<Writer> writers;
    const auto has_stack = [&] {
      const bool chosen = random() % 2 == 0;
      return bodies == Bodies::mixed ? chosen : bodies == Bodies::with_stacks;
    };
    std::vector<Channel<Words>*> channels;
    Processor& companion = lab.machine.add_companion(cpu, "companion");
    for (std::size_t i = 0; i < INPUTS; ++i) {
      const auto where = random() % 3;
      Processor& from = where == 0 ? cpu : where == 1 ? companion : lab.neighbour(cpu);
      const auto protocol = static_cast<Protocol>(random() % 3);
      const auto name = fmt::format("channel {}", i);
      channels.push_back(
          where < 2 ? &lab.channels.emplace_back(name, from, cpu, protocol)
                    : &lab.channels.emplace_back(name, lab.machine.link(from, cpu), protocol));
      const auto computes = static_cast<std::int64_t>(random() % 2000);
      const auto priority = BOTH_PRIORITIES[random() % 2];
      start(from, priority, has_stack(), writers.emplace_back(Writer{*channels[i], computes}));
    }
    Reader reader{random() % 2 == 0, channels};
    const auto priority = BOTH_PRIORITIES[random() % 2];
    start(cpu, priority, has_stack(), reader);
    lab.machine.run();
    reader.seen.push_back(lab.cycles());
    reader.seen.push_back(lab.busy_cycles(cpu));
    return reader.seen;
  });
}

// start() must refuse a function that returns a Proc, because the function would make a Proc and
// drop it.
template <class Body>
concept CanStart = requires(Processor& cpu, Body body) {
  cpu.start("", Priority::low, body);
};
static_assert(CanStart<void (*)()> && !CanStart<Proc (*)()>);

TEST(Proc, TakesTheTimesOfAProcessWithAStack) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const auto expected = run(seed, Bodies::with_stacks);
    EXPECT_EQ(expected.size(), 2 * INPUTS * MESSAGES + 2);
    EXPECT_EQ(run(seed, Bodies::without), expected);
    EXPECT_EQ(run(seed, Bodies::mixed), expected);
  }
}

Proc compute_and_count(std::int64_t cycles, int& count) {
  compute(cycles);
  co_await machine::Sync();
  ++count;
}

TEST(Proc, WaitsForAnotherProc) {
  const auto found = isolated_numbers([] {
    Lab lab;
    int count = 0;
    Numbers cycles;
    const auto body = [&]() -> Proc {
      co_await compute_and_count(100, count);
      cycles.push_back(own_cycles());
      co_await compute_and_count(0, count);
      co_await compute_and_count(50, count);
      cycles.push_back(own_cycles());
    };
    for (const auto priority : BOTH_PRIORITIES) lab.cpu().start("process", priority, body());
    lab.machine.run();
    cycles.push_back(count);
    return cycles;
  });
  EXPECT_EQ(found, (Numbers{100, 100, 150, 150, 6}));
}

TEST(Proc, EndsWhenItsOwnTimeHasCome) {
  const auto cycles = isolated_numbers([] {
    Lab lab;
    const auto body = []() -> Proc {
      compute(700);
      co_return;
    };
    lab.cpu().start("process", Priority::low, body());
    lab.machine.run();
    return Numbers{lab.cycles()};
  });
  EXPECT_EQ(cycles, Numbers{700});
}

// The example of the manual.
Proc relay(Channel<Words>& from, Channel<Words>& to) {
  for (;;) co_await to.output(co_await from.input());
}

TEST(Proc, PassesOnWhatItAwaits) {
  const auto found = isolated_numbers([] {
    Lab lab;
    auto &first = lab.soft(), &second = lab.soft();
    lab.cpu().start("relay", Priority::high, relay(first, second)).set_server();
    Processor& cpu = *lab.machine.processors().front();
    Numbers got;
    cpu.start("writer", Priority::low, [&] {
      for (std::uint64_t i = 0; i < 3; ++i) out(first, {4, i});
    });
    cpu.start("reader", Priority::low, [&] {
      for (int i = 0; i < 3; ++i) got.push_back(static_cast<double>(second.in().content));
    });
    lab.machine.run();
    return got;
  });
  EXPECT_EQ(found, (Numbers{0, 1, 2}));
}

// The body of a guard throws, whether the message was already there or not.
TEST(Proc, CatchesWhatIsThrownInAnAlt) {
  const auto found = isolated_numbers([] {
    Numbers caught;
    for (const std::int64_t late : {0, 1000}) {
      Lab lab(make_exact_model(), machine::Code::bare, {.links = machine::Links::direct});
      Processor& cpu = lab.cpu();
      auto& channel = lab.soft();
      const auto body = [&]() -> Proc {
        Words got;
        compute(500);
        co_await machine::Sync();
        try {
          co_await alternative(when(channel, got, [] { throw std::runtime_error("no"); }));
        } catch (const std::runtime_error&) {
          caught.push_back(static_cast<double>(got.content));
        }
      };
      cpu.start("reader", Priority::low, body());
      cpu.start("writer", Priority::low, [&] {
        compute(late);
        out(channel, {4, 7});
      });
      lab.machine.run();
    }
    return caught;
  });
  EXPECT_EQ(found, (Numbers{7, 7}));
}

// The ALT has no guard with a true condition. The process notices this error only after it has
// waited.
TEST(Proc, CatchesWhatAnOperationThrowsAfterItHasWaited) {
  const auto found = isolated_numbers([] {
    Lab lab;
    Numbers caught;
    const auto body = [&]() -> Proc {
      compute(2000);
      try {
        co_await alternative(otherwise(false, [] {}));
      } catch (const machine::Misuse&) {
        caught.push_back(own_cycles() > 2000);
      }
    };
    lab.cpu().start("process", Priority::low, body());
    lab.machine.run();
    return caught;
  });
  EXPECT_EQ(found, (Numbers{1}));
}

// An operation throws in a process with a stack. The body must be able to catch this and continue.
TEST(Operation, ThrowsInTheBodyAfterItHasWaited) {
  const auto found = isolated_numbers([] {
    Lab lab;
    Numbers caught;
    Processor& cpu = lab.cpu();
    auto& channel = lab.soft();
    cpu.start("process", Priority::low, [&] {
      compute(2000);
      try {
        pri_alt(otherwise(false, [] {}));
      } catch (const machine::Misuse&) {
        caught.push_back(own_cycles() > 2000);
      }
      out(channel, {4, 7});
    });
    cpu.start("reader", Priority::low,
              [&] { caught.push_back(static_cast<double>(channel.in().content)); });
    lab.machine.run();
    return caught;
  });
  EXPECT_EQ(found, (Numbers{1, 7}));
}

// Objects of a process must be destroyed with the machine, or when the body has ended.
TEST(Proc, IsUnwoundWhereItWaits) {
  const auto found = isolated_numbers([] {
    const auto held = std::make_shared<int>(1);
    double while_it_ran = 0;
    {
      Lab lab;
      // An object whose destructor uses the process.
      struct Asks {
        ~Asks() { EXPECT_EQ(this_process().name(), "process"); }
      };
      const auto body = [](std::shared_ptr<int>, Channel<Words>* never) -> Proc {
        const Asks asks;
        if (never) co_await never->input();
      };
      Processor& cpu = lab.cpu();
      cpu.start("process", Priority::high, body(held, &lab.soft())).set_server();
      cpu.start("process", Priority::low, body(held, nullptr));
      lab.machine.run();
      while_it_ran = static_cast<double>(held.use_count());
    }
    return Numbers{while_it_ran, static_cast<double>(held.use_count())};
  });
  EXPECT_EQ(found, (Numbers{2, 1}));
}

// Runs a process, and returns the message of the deadlock, fault, or wait without co_await.
std::string report(std::function<Proc(Lab&)> body) {
  return isolated([&] {
    Lab lab(make_exact_model(), machine::Code::bare, {.links = machine::Links::direct});
    try {
      Processor& cpu = lab.cpu();
      cpu.start("process", Priority::high, body(lab));
      lab.machine.run();
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  });
}

Proc wait_for(Channel<Words>& never) { co_await never.input(); }
Proc choose_from(Channel<Words>& never) {
  Words got;
  co_await alternative(when(never, got, [] {}));
}
Proc choose_from_none() {
  co_await alternative(otherwise(false, [] {}));
}
Proc wait_on_a_stack(Channel<Words>& never) {
  never.in();
  co_return;
}

void expect_in(const std::string& report, std::string_view text) {
  EXPECT_TRUE(report.find(text) != std::string::npos) << report;
}

Proc write(Channel<Words>& channel) { co_await channel.output({}); }

TEST(Proc, IsNamedInReports) {
  expect_in(report([](Lab& lab) {
              auto& channel = lab.soft();
              Processor& cpu = *lab.machine.processors().front();
              cpu.start("other", Priority::high, write(channel));
              return write(channel);
            }),
            "process on cpu 0 outputs to channel soft 0 at 0.000001 s, which other on cpu 0 "
            "already uses");
  expect_in(report([](Lab&) { return Proc{}; }), "process on cpu 0 has no body");
  expect_in(report([](Lab& lab) { return wait_for(lab.soft()); }),
            "process on cpu 0 waits for in on soft 0");
  expect_in(report([](Lab& lab) { return choose_from(lab.soft()); }),
            "process on cpu 0 waits for alt on soft 0");
  expect_in(report([](Lab&) { return choose_from_none(); }),
            "process on cpu 0 is in an ALT without an open guard");
  expect_in(report([](Lab& lab) { return wait_on_a_stack(lab.soft()); }),
            "process has no stack to wait on");
}

}  // namespace
}  // namespace occam::proc_test
