// Independent simulation of messages that processes relay while DMA slows the CPUs. It is a list of
// activities, and uses no code of the simulator.
//
// Every process has high priority and relays the messages of one stream: it inputs, computes and
// outputs. A CPU runs its processes first come, first served, by the date of becoming ready; each
// keeps the CPU until it reaches a link. A transfer on a link slows all work on the CPUs at its
// ends, from its start to its end.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace dma_oracle {

struct Machine {
  double clock;               // clock rate in cycles/s
  double one_way, both_ways;  // rates of a link in bytes/s: one direction alone, both together
  double steal_byte;          // cycles that DMA takes for each byte, at each end
  double come_to_link;        // cycles of the instruction that inputs or outputs
};

struct Relay {
  int processor;
  double computes;  // cycles that the process computes for each message
};
struct Stream {
  std::vector<Relay> relays;    // from the source to the sink
  std::vector<double> lengths;  // lengths of the stream's messages in bytes
};

class Simulation {
 public:
  Simulation(const Machine& machine, int processors, const std::vector<Stream>& streams)
      : machine_(machine), cpus_(processors), arrived_s_(streams.size()) {
    for (std::size_t s = 0; s < streams.size(); ++s)
      for (std::size_t i = 0; i < streams[s].relays.size(); ++i)
        processes_.push_back({&streams[s], s, i});
    for (Process& process : processes_) {
      begin_message(process);
      cpus_[process.relay().processor].ready.push_back(&process);
    }
  }

  // Runs until no activity is left. Returns for each stream the dates in seconds at which the sink
  // has computed its messages.
  std::vector<std::vector<double>> run() {
    for (;;) {
      for (Cpu& cpu : cpus_)
        if (!cpu.running && !cpu.ready.empty()) {
          cpu.running = cpu.ready.front();
          cpu.ready.pop_front();
        }
      const double step_s = time_to_next();
      if (step_s == NEVER) return arrived_s_;
      advance(step_s);
    }
  }

 private:
  static constexpr double NEVER = std::numeric_limits<double>::infinity();

  enum class Step { comes_to_input, computes, comes_to_output };
  struct Process {
    const Stream* stream;
    std::size_t number, place;  // indices of the stream, and of the relay within it
    std::size_t message = 0;
    Step step{};
    double left = 0;  // cycles left in this step
    const Relay& relay() const { return stream->relays[place]; }
    bool is_source() const { return place == 0; }
    bool is_sink() const { return place + 1 == stream->relays.size(); }
  };
  struct Cpu {
    std::deque<Process*> ready;
    Process* running = nullptr;
  };
  struct Direction {
    Process *writer = nullptr, *reader = nullptr;
    double left = 0;  // bytes left of the present transfer
  };

  void spend(Process& process, Step step, double cycles) {
    process.step = step;
    process.left = cycles;
  }
  void begin_message(Process& process) {
    if (process.is_source())
      spend(process, Step::computes, process.relay().computes);
    else
      spend(process, Step::comes_to_input, machine_.come_to_link);
  }
  Direction& direction(const Process& process, std::size_t from) {
    const auto& relays = process.stream->relays;
    return directions_[{relays[from].processor, relays[from + 1].processor}];
  }
  bool is_busy(int from, int to) const {
    const auto found = directions_.find({from, to});
    return found != directions_.end() && found->second.left > 0;
  }
  double bytes_per_s(int from, int to) const {
    return is_busy(to, from) ? std::min(machine_.one_way, machine_.both_ways / 2)
                             : machine_.one_way;
  }
  double cycles_per_s(int cpu) const {
    double stolen = 0;
    for (const auto& [ends, direction] : directions_)
      if (direction.left > 0 && (ends.first == cpu || ends.second == cpu))
        stolen += machine_.steal_byte * bytes_per_s(ends.first, ends.second);
    return machine_.clock - stolen;
  }

  double time_to_next() const {
    double step_s = NEVER;
    for (std::size_t i = 0; i < cpus_.size(); ++i)
      if (cpus_[i].running)
        step_s = std::min(step_s, cpus_[i].running->left / cycles_per_s(static_cast<int>(i)));
    for (const auto& [ends, direction] : directions_)
      if (direction.left > 0)
        step_s = std::min(step_s, direction.left / bytes_per_s(ends.first, ends.second));
    return step_s;
  }

  // An activity counts as ended if at most HAIR cycles or bytes are left.
  static constexpr double HAIR = 1e-7;

  void advance(double step_s) {
    std::vector<double> speeds, rates;
    for (std::size_t i = 0; i < cpus_.size(); ++i)
      speeds.push_back(cycles_per_s(static_cast<int>(i)));
    for (const auto& [ends, direction] : directions_)
      rates.push_back(bytes_per_s(ends.first, ends.second));
    now_s_ += step_s;
    std::size_t n = 0;
    std::vector<Direction*> ended;
    for (auto& [ends, direction] : directions_) {
      const double rate = rates[n++];
      if (direction.left <= 0) continue;
      direction.left -= step_s * rate;
      if (direction.left < HAIR) ended.push_back(&direction);
    }
    for (std::size_t i = 0; i < cpus_.size(); ++i) {
      if (!cpus_[i].running) continue;
      cpus_[i].running->left -= step_s * speeds[i];
      if (cpus_[i].running->left < HAIR) end_step(cpus_[i], *cpus_[i].running);
    }
    for (Direction* direction : ended) end_transfer(*direction);
  }

  void end_step(Cpu& cpu, Process& process) {
    if (process.step == Step::computes) {
      if (!process.is_sink()) return spend(process, Step::comes_to_output, machine_.come_to_link);
      arrived_s_[process.number].push_back(now_s_);
      if (++process.message < process.stream->lengths.size()) return begin_message(process);
      cpu.running = nullptr;
      return;
    }
    cpu.running = nullptr;
    const bool is_output = process.step == Step::comes_to_output;
    Direction& link = direction(process, is_output ? process.place : process.place - 1);
    (is_output ? link.writer : link.reader) = &process;
    if (link.writer && link.reader) link.left = process.stream->lengths[process.message];
  }

  void end_transfer(Direction& link) {
    link.left = 0;
    Process& writer = *std::exchange(link.writer, nullptr);
    Process& reader = *std::exchange(link.reader, nullptr);
    spend(reader, Step::computes, reader.relay().computes);
    cpus_[reader.relay().processor].ready.push_back(&reader);
    if (++writer.message == writer.stream->lengths.size()) return;
    begin_message(writer);
    cpus_[writer.relay().processor].ready.push_back(&writer);
  }

  Machine machine_;
  std::vector<Cpu> cpus_;
  std::deque<Process> processes_;
  std::map<std::pair<int, int>, Direction> directions_;
  std::vector<std::vector<double>> arrived_s_;
  double now_s_ = 0;
};

}  // namespace dma_oracle
