#pragma once
// The parts of a machine, each run by a thread of the host.
//
// Processors interact over links only, and each operation on a link takes a minimum time, the
// lookahead. All parts therefore run in parallel for a window of that length. Events on links
// between parts are scheduled before the window and handled while all threads wait. (Conservative
// windows: R. M. Fujimoto, Parallel discrete event simulation, CACM 33(10), 1990.) The order of
// simultaneous events does not matter on two processors, and on links it follows the link numbers.
// Results are therefore the same for any number of parts.
#include <memory>
#include <string>
#include <vector>

#include "simulator/machine/engine.hpp"

namespace machine {

class Processor;

class Parts {
 public:
  explicit Parts(EngineParams params);

  /// Adds a processor and returns its engine: `beside`, or else that of its part in the params.
  Engine& add_processor(const std::string& name, const Engine* beside = nullptr);
  /// Engine of the links between processors of two engines.
  Engine& between(Engine& a, Engine& b) { return &a == &b ? a : *between_; }

  bool is_one() const { return engines_.size() == 1; }
  /// The engine of the only part. Throws InvariantBroken for more: they do not support `asked`.
  Engine& only(const char* asked);

  /// See Engine. `lookahead`: minimum time from the start of a link operation to the link.
  Engine::End run(Seconds until, Seconds lookahead);
  Seconds now() const { return engines_.front()->now(); }  ///< before a run and after it
  void rewind();
  void stop();
  std::uint64_t handled() const;

  /// Counts of windows so far, for several parts.
  struct Windows {
    std::uint64_t all = 0, shared = 0;  ///< shared: with events in several parts
    std::uint64_t at_links = 0;         ///< events on links between parts, outside of windows
  };
  Windows windows() const { return windows_; }

 private:
  Engine::End run_windows(Seconds until, Seconds lookahead);
  double latest() const;
  void be_at(double date);
  Moment end_of_window(double date, double lookahead) const;
  const Events* stopped() const;

  std::vector<int> part_of_;
  std::vector<std::unique_ptr<Engine>> engines_;
  std::unique_ptr<Engine> between_;  // of links between parts; null for one part
  int processors_ = 0;
  Moment bound_;  // end of the window
  Windows windows_;
};

}  // namespace machine
