#pragma once
// A machine divided into parts. A host thread runs each part.
//
// Processors interact only over links, and any process needs a minimum time to reach a link, the
// lookahead. During a window of this length, all parts can therefore run in parallel. Events on
// links between parts are scheduled before a window and handled between windows, while all threads
// wait. (Conservative windows: R. M. Fujimoto, Parallel discrete event simulation, CACM 33(10),
// 1990.)
//
// Simultaneous events on different processors are independent, and simultaneous events on links are
// handled in the order of link numbers. Results are therefore the same for any number of parts.
#include <memory>
#include <string>
#include <vector>

#include "simulator/machine/engine.hpp"

namespace machine {

class Processor;

class Parts {
 public:
  Parts(EngineParams params = {});

  /// Adds a processor and returns its engine: `beside` if this is not null, otherwise the engine of
  /// the part that EngineParams::parts names.
  Engine& add_processor(const std::string& name, const Engine* beside = nullptr);
  /// The engine that runs the links between processors whose engines are `a` and `b`.
  Engine& between(Engine& a, Engine& b) { return &a == &b ? a : *between_; }

  bool is_one() const { return engines_.size() == 1; }
  /// The engine of a machine in one part. With several parts, throws InvariantBroken with the
  /// message that the feature `asked` is not supported.
  Engine& only(const char* asked);

  /// Runs as Engine::run does. `lookahead` is the minimum time that a process needs to reach a
  /// link.
  Engine::End run(Seconds until, Seconds lookahead);
  Seconds now() const { return engines_.front()->now(); }  ///< valid only between runs
  void rewind();
  void stop();
  std::uint64_t handled() const;

  /// Numbers of windows so far. In a window, an interval of simulated time, all parts run in
  /// parallel. Only for a machine in several parts.
  struct Windows {
    std::uint64_t all = 0, shared = 0;  ///< windows; `shared`: those with events in several parts
    std::uint64_t at_links = 0;         ///< windows for events on links between parts
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
  // The engine for links between parts; null if there is one part.
  std::unique_ptr<Engine> between_;
  int processors_ = 0;
  Moment bound_;  // end of the present window
  Windows windows_;
};

}  // namespace machine
