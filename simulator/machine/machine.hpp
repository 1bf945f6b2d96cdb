#pragma once
// A machine: processors joined by links, run until every process has ended.
#include <memory>
#include <vector>

#include "simulator/machine/processor.hpp"

namespace machine {

struct LinkUse {
  Seconds busy{};
  std::uint64_t messages = 0, bytes = 0;  // that have arrived
  std::uint64_t bytes_sent = 0;           // that have been put on the link
};

// One direction of a link: its DMA engine moves one message at a time.
class LinkDirection {
 public:
  LinkDirection(Engine& engine, Processor& from, Processor& to)
      : engine_(engine), from_(from), to_(to) {}
  // Both processes have been descheduled; calls back when the last byte has been acknowledged.
  void transfer(std::uint64_t bytes, Engine::Callback arrived);

  Processor& from() const { return from_; }
  Processor& to() const { return to_; }
  LinkUse use() const;  // up to now; a message counts when it has arrived
  std::string name() const { return from_.name() + " > " + to_.name(); }

 private:
  Engine& engine_;
  Processor& from_;
  Processor& to_;
  LinkUse use_;
  bool busy_ = false;
  Seconds since_{};  // of the transfer under way: its start,
  std::uint64_t bytes_ = 0;
  Engine::Callback arrived_;
};

class Machine {
 public:
  explicit Machine(const Model& model) : model_(model) {}

  // `memory` in bytes.
  Processor& add_processor(std::string name, std::uint64_t memory);
  // Joins two processors. Throws InvariantBroken beyond four links a processor.
  void connect(Processor& a, Processor& b);
  LinkDirection& link(const Processor& from, const Processor& to);

  // Runs until no process can do anything. Throws what a process threw; Deadlock, with who waits
  // on which channel, if some have not ended.
  void run();

  Seconds now() const { return engine_.now(); }
  std::uint64_t events() const { return events_; }
  const Model& model() const { return model_; }
  const std::vector<std::unique_ptr<Processor>>& processors() const { return processors_; }
  const std::vector<std::unique_ptr<LinkDirection>>& links() const { return links_; }

 private:
  const Model model_;
  Engine engine_;
  std::vector<std::unique_ptr<Processor>> processors_;
  std::vector<std::unique_ptr<LinkDirection>> links_;
  std::uint64_t events_ = 0;
};

}  // namespace machine
