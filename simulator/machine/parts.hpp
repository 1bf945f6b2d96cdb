#pragma once
// A machine divided into parts, each run by a host thread.
//
// Processors interact only over links, and reaching a link takes a minimum time, the lookahead. All
// parts therefore run in parallel for a window of this length. Events on links between parts are
// scheduled before the window and handled between windows, while all threads wait. (Conservative
// windows: R. M. Fujimoto, Parallel discrete event simulation, CACM 33(10), 1990.)
//
// Simultaneous events on different processors are independent, and those on links are ordered by
// link number. Results are therefore the same for any number of parts.
#include <memory>
#include <string>
#include <vector>

#include "simulator/machine/engine.hpp"

namespace machine {

class Processor;

class Parts {
 public:
  Parts(EngineParams params = {});

  /// Adds a processor and returns its engine: `beside` if given, otherwise the engine of the part
  /// that EngineParams::parts names.
  Engine& add_processor(const std::string& name, const Engine* beside = nullptr);
  /// The engine for links between processors with engines `a` and `b`.
  Engine& between(Engine& a, Engine& b) { return &a == &b ? a : *between_; }

  bool is_one() const { return engines_.size() == 1; }
  /// The engine of a machine in one part. With several parts, throws InvariantBroken: such machines
  /// do not support the feature `asked`.
  Engine& only(const char* asked);

  /// Runs like Engine::run. `lookahead` is the minimum time that a process needs to reach a link.
  Engine::End run(Seconds until, Seconds lookahead);
  Seconds now() const { return engines_.front()->now(); }  ///< valid only between runs
  void rewind();
  void stop();
  std::uint64_t handled() const;

  /// Counts of windows so far, for a machine in several parts.
  struct Windows {
    std::uint64_t all = 0, shared = 0;  ///< shared: windows with events in several parts
    std::uint64_t at_links = 0;         ///< events on links between parts
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
  std::unique_ptr<Engine> between_;  // for links between parts; null if there is one part
  int processors_ = 0;
  Moment bound_;  // end of the window
  Windows windows_;
};

}  // namespace machine
