#pragma once
// Processes of a worker (thesis, 4.3.6.2). At high priority: a data router with a sender for each
// way out, and a results router ("gatherer"). At low priority: the application.
#include <span>
#include <vector>

#include "simulator/farm/messages.hpp"

namespace farm {

/// Buffers one way out, so that the router does not block on it: signals that it is free, takes a
/// message and passes it on (figure 4.13).
void sender(Channel<Signal>& sender_to_main, Channel<Task>& from_main, Channel<Task>& destination);

/// Passes each task to a free sender, in fair turns (figure 4.14), and messages for all workers to
/// every sender.
void data_router(Channel<Task>& from_left, std::span<Channel<Signal>* const> from_sender,
                 std::span<Channel<Task>* const> into_sender);

/// Merges results of the application and of the workers behind into one channel towards the
/// coordinator (figure 4.12).
void results_router(std::span<Channel<Answer>* const> inputs, Channel<Answer>& output);

/// Scene, parameters and costs of a worker's tasks.
struct Kernel {
  const renderer::Scene& scene;
  const renderer::Params& params;
  kernels::KernelCost ray, block;
  kernels::RecordBytes bytes;
  kernels::ByModel<kernels::MessageCosts> message;
  std::map<int, std::uint64_t> done = {};  ///< tasks, by the processor's id
  renderer::BlockBuffer scratch = {};
};

/// Finds each ray's first intersection, or renders blocks of pixels. The kernel really runs; the
/// processor is charged for its work.
void application(Kernel& kernel, Channel<Task>& from_router, Channel<Answer>& results);

}  // namespace farm
