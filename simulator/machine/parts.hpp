#pragma once
// The parts of a machine, each run by a thread of the host.
//
// Processors reach each other over links alone, and a process comes to a link no sooner than an
// operation on it takes. So all parts may go on side by side for a window of that length; only what
// happens on links between them, which is asked for before the window, is handled while all threads
// stand still. (Conservative windows: R. M. Fujimoto, Parallel discrete event simulation, CACM
// 33(10), 1990.) What happens at one instant on two processors does not depend on its order, and on
// links the order is that of their numbers: so results are the same in any number of parts.
#include <memory>
#include <string>
#include <vector>

#include "simulator/machine/engine.hpp"

namespace machine {

class Processor;

class Parts {
 public:
  explicit Parts(EngineParams params);

  /// The engine of the next processor, in a part that is given or the one that the params say.
  Engine& add_processor(const std::string& name, const Engine* beside = nullptr);
  /// That of links between two of them.
  Engine& between(Engine& a, Engine& b) { return &a == &b ? a : *between_; }

  bool is_one() const { return engines_.size() == 1; }
  /// The engine, if there is one part. For more throws InvariantBroken: they cannot do what is
  /// asked.
  Engine& only(const char* asked);

  /// See Engine. A process comes to a link at the earliest `lookahead` after it has begun to.
  Engine::End run(Seconds until, Seconds lookahead);
  Seconds now() const { return engines_.front()->now(); }  ///< before a run and after it
  void rewind();
  void stop();
  std::uint64_t handled() const;

  /// What several parts have done so far.
  struct Windows {
    std::uint64_t all = 0, shared = 0;  ///< shared: something happens in several parts
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
  std::unique_ptr<Engine> between_;  // of more than one
  int processors_ = 0;
  Moment bound_;  // of the window
  Windows windows_;
};

}  // namespace machine
