#pragma once
// Processes of a worker (thesis, 4.3.6.2). Two kinds of process run at high priority: a data router
// with one sender process for each way out, and a results router, which collects results. The
// application runs at low priority.
#include <span>
#include <vector>

#include "simulator/farm/messages.hpp"

namespace farm {

/// Buffers one message for a way out of the data router, so that the router never blocks. Signals
/// the router when the buffer is empty, takes a message and forwards it (thesis, figure 4.13).
void sender(Channel<Signal>& sender_to_main, Channel<Task>& from_main, Channel<Task>& destination);

/// Forwards each task to a free sender, chosen in rotation (thesis, figure 4.14). Forwards messages
/// for all workers to every sender.
void data_router(Channel<Task>& from_left, std::span<Channel<Signal>* const> from_sender,
                 std::span<Channel<Task>* const> into_sender);

/// Merges the results of the worker's own application and of its children in the tree into one
/// channel towards the coordinator (thesis, figure 4.12).
void results_router(std::span<Channel<Answer>* const> inputs, Channel<Answer>& output);

/// Scene, parameters and costs of a worker's tasks.
struct Kernel {
  const renderer::Scene& scene;
  const renderer::Params& params;
  kernels::KernelCost ray, block;
  kernels::RecordBytes bytes;
  kernels::ByModel<kernels::MessageCosts> message;
  std::map<int, std::uint64_t> done = {};  ///< number of tasks done, by processor id
  renderer::BlockBuffer scratch = {};
};

/// Process that finds the first intersection of each ray, or renders blocks of pixels. The kernel
/// is executed on the host; its counted work is charged to the simulated processor.
void application(Kernel& kernel, Channel<Task>& from_router, Channel<Answer>& results);

}  // namespace farm
