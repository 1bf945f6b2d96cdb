#pragma once
// A machine: processors joined by links, run until every process has ended.
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "simulator/machine/link.hpp"

namespace machine {

// Why a run ended: every process did, its time was up, or the user wanted no more.
enum class End { done, limit, interrupt };
std::string_view to_string(End end);

class Machine {
 public:
  // `software_factor` multiplies the cycles of occam's channel instructions: 1 is what the data
  // sheet says they take, model.software.occam_factor what they took the thesis's programs.
  explicit Machine(const Model& model, double software_factor = 1)
      : model_(model), software_factor_(software_factor) {}

  // `memory` in bytes.
  Processor& add_processor(std::string name, std::uint64_t memory);
  // Joins two processors, through a number of C004 link switches. Throws InvariantBroken beyond
  // four links a processor, and for a second link between two.
  void connect(Processor& a, Processor& b, int switches = 0);
  LinkDirection& link(const Processor& from, const Processor& to);

  // Who is told what processors and links do; before run().
  void set_observer(Observer& observer);

  // Runs until no process can do anything, or up to a time limit. Throws what a process threw;
  // Deadlock, with who waits on which channel, if some have not ended and there was no limit.
  End run(Seconds until = {std::numeric_limits<double>::infinity()});

  Seconds now() const { return engine_.now(); }
  std::uint64_t events() const { return engine_.handled(); }
  const Model& model() const { return model_; }
  const std::vector<std::unique_ptr<Processor>>& processors() const { return processors_; }
  const std::vector<std::unique_ptr<LinkDirection>>& links() const { return links_; }

 private:
  const Model model_;
  double software_factor_;
  Engine engine_;
  std::vector<std::unique_ptr<Processor>> processors_;
  std::vector<std::unique_ptr<LinkDirection>> links_;
  std::vector<std::size_t> ports_;  // in use, by processor
  std::map<std::pair<int, int>, LinkDirection*> link_of_;
};

}  // namespace machine
