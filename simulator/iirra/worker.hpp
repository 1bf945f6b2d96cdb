#pragma once
// The sequential process of a worker, which alternates between application, data manager and task
// manager (thesis, 5.1.3 and figure 5.4).
#include <deque>

#include "simulator/iirra/task_manager.hpp"

namespace iirra {

class Worker final : private TaskGiver {
 public:
  Worker(Shared& shared, shared_memory::DataManager& manager, Peers peers);
  /// Works on tasks until stopped, then only serves scene data.
  void run();

 private:
  void work();
  void rest();

  // The functions that perform one step of a task.
  void advance(const Task& task);
  void sample_next_level(TaskCell& cell);
  void divide_cell(const TaskCell& cell);
  void deepen(const SampledCell& cell, int pass, int level);

  // The functions that send and handle messages.
  void serve_waiting();
  void serve_urgent();
  void obey(const network::Message& message);
  void measure(int asker, const Measure& measure);
  void send_pictures();

  std::size_t load() const override { return tasks_.active(); }
  std::size_t give(int to) override;
  void send_to(network::Address to, IirraMessage content) override;
  void pass_on(const network::Message& message) override;

  Shared& shared_;
  shared_memory::DataManager& manager_;
  const Params& params_;
  const Sizes& sizes_;
  Counts& counts_;
  std::unique_ptr<Balance> balance_;
  Sampler sampler_;
  FrameBuffers unshown_;
  TaskManager tasks_;
  bool is_under_way_ = false;  // the last picture sent without a poll is not acknowledged
  // Messages that wait until the current sample is complete.
  std::deque<network::Message> deferred_;
  bool has_begun_;  // true when the first tasks, or the empty first message, have arrived
  bool is_stopped_ = false;
};

}  // namespace iirra
