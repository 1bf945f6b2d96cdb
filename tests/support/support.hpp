// What the tests of the machine and of its vocabulary share.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <deque>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/laboratory/host/jobs.hpp"
#include "simulator/occam/alt.hpp"
#include "simulator/occam/channel.hpp"
#include "simulator/occam/process.hpp"

namespace occam {

using Numbers = std::vector<double>;
using machine::Model;
using machine::Processor;

constexpr Priority BOTH_PRIORITIES[] = {Priority::high, Priority::low};

// A message of any length that carries a number.
struct Words {
  std::uint64_t length = 4, content = 0;
  std::uint64_t bytes() const { return length; }
};

// A simulation in a process of its own, since SimGrid's engine is a singleton. Failures are thrown
// as laboratory::JobFailed; so is a simulation that does not end.
inline std::string isolated(const std::function<std::string()>& body) {
  auto job = [&](std::size_t) {
    alarm(120);
    return body();
  };
  return laboratory::run_jobs(1, 1, job).front();
}

inline Numbers isolated_numbers(const std::function<Numbers()>& body) {
  std::istringstream words(isolated([&] {
    std::string text;
    for (double number : body()) text += fmt::format("{:a} ", number);
    return text;
  }));
  Numbers numbers;
  for (std::string word; words >> word;) numbers.push_back(std::strtod(word.c_str(), nullptr));
  return numbers;
}

// t805-25 without operands' loads and DMA's stolen cycles, and with a clock, ticks and links of
// powers of two, so that every time is a whole number of cycles and has no rounding.
inline Model make_exact_model() {
  Model model = machine::load_model("t805-25");
  model.memory.steal_word = 0;
  for (machine::Cycles* beside : {&model.channel.operands, &model.channel.out_word})
    *beside = {0};  // counted in tests of their own
  model.cpu.clock = {0x1p24};
  model.timer.high_tick = 0x1p-20;  // 16 cycles
  model.timer.low_tick = 0x1p-14;   // 1024 cycles
  model.scheduler.slice = {4096};
  model.link.one_way_rate = 0x1p20;  // 16 cycles a byte
  model.link.both_ways_rate = 0x1.8p20;
  return model;
}

inline std::int64_t words_in(std::uint64_t bytes) {
  return static_cast<std::int64_t>((bytes + 3) / 4);
}

// What the end that comes second spends on a soft channel.
inline std::int64_t soft_cost(const Model& model, std::uint64_t bytes) {
  return (model.channel.soft_setup + words_in(bytes) * model.channel.copy_word).value;
}

// This process's own time.
inline double own_cycles() {
  return this_process().now().value * this_process().processor().clock().value;
}

inline void compute(std::int64_t cycles) { this_process().charge({cycles}); }

inline void wait_until_cycle(std::int64_t cycle) {
  wait_until(ticks(Cycles{cycle} / this_process().processor().clock()));
}

// A machine and what its processes share. Built and run inside of isolated().
struct Lab {
  explicit Lab(const Model& model = make_exact_model(), double software_factor = 1)
      : machine(model, software_factor) {}

  Processor& cpu() {
    return machine.add_processor(fmt::format("cpu {}", machine.processors().size()), 1 << 20);
  }
  Processor& neighbour(Processor& other) {
    Processor& added = cpu();
    machine.connect(other, added);
    return added;
  }
  Channel<Words>& soft() { return channels.emplace_back(fmt::format("soft {}", channels.size())); }
  Channel<Words>& hard(Processor& from, Processor& to) {
    auto& link = machine.link(from, to);
    return channels.emplace_back(link.name(), link);
  }
  double cycles() const { return machine.now().value * machine.model().cpu.clock.value; }
  double busy_cycles(const Processor& cpu) const {
    return cpu.use().busy().value * machine.model().cpu.clock.value;
  }

  std::deque<Channel<Words>> channels;
  machine::Machine machine;
};

}  // namespace occam
