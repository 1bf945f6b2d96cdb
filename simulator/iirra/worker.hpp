#pragma once
// The sequential process of a computing processor, which alternates between application, data
// manager and task manager (thesis, figure 5.4 and 5.1.3).
#include <deque>

#include "simulator/iirra/frame_buffers.hpp"

namespace iirra {

class Worker : private TaskGiver {
 public:
  Worker(Shared& shared, shared_memory::DataManager& manager, Peers peers);
  /// Works until stopped, then only serves data.
  void run();

 private:
  void work();

  // The application (AP).
  void advance(const Task& task);
  void sample_next_level(TaskCell& cell);
  void divide_cell(const TaskCell& cell);
  void deepen(const SampledCell& cell, int pass, int level);
  void trace(Sample& sample, const renderer::Ray& ray, bool is_outside);
  void extend(Sample& sample, const Point& point);
  int find_wanted(Sample& sample, const Point& point);
  Traced shoot(Sample& sample, const renderer::Ray& ray, bool is_outside);

  // The task manager (TM).
  void put(const TaskCell& cell, bool has_just_come = false);
  void finish(TaskCell cell);
  void rest();
  void report();
  std::uint64_t pixels_of(const SampledCell& cell) const;
  MovedCell pack(const TaskCell& cell);
  void unpack(const MovedCell& moved, bool is_first);
  void charge_work();

  // The network.
  void serve_waiting();
  void look();
  void obey(const network::Message& message);
  void begin_phase(const NewPhase& phase);
  void measure(int asker, const Measure& measure);
  void send_pictures();

  std::size_t load() const override { return stores_.active(); }
  std::size_t give(int to) override;
  void send_to(network::Address to, IirraMessage::Content content) override;
  void pass_on(const network::Message& message) override;

  Shared& shared_;
  shared_memory::DataManager& manager_;
  const Params& params_;
  const Sizes& sizes_;
  Counts& counts_;
  const Ordering ordering_;
  std::unique_ptr<Balance> balance_;
  TaskStores stores_;
  SampleTable samples_;
  std::unordered_map<std::uint32_t, std::uint32_t> corners_;  // objects at pixel corners
  TaskWork work_;
  Limits limits_;
  std::uint32_t phase_ = 0;
  int order_ = 0;                                    // the user's order that set the limits
  std::uint64_t finished_ = 0;                       // number of finished pixels
  std::uint64_t new_parked_ = 0, new_finished_ = 0;  // not yet reported in this phase
  FrameBuffers unshown_;
  bool is_under_way_ = false;              // an unrequested picture has not been acknowledged yet
  std::deque<network::Message> deferred_;  // messages to handle after the current sample
  std::optional<Point> open_;              // the current sample
  bool has_begun_;                         // the first message with tasks has arrived
  bool is_stopped_ = false;
};

}  // namespace iirra
