#pragma once
// Processes of a worker (thesis, 4.3.6.2). High priority: a data router with a sender for each way
// out, and a results router ("gatherer"). Low priority: the application.
#include <span>
#include <vector>

#include "simulator/farm/messages.hpp"

namespace farm {

/// Buffers one message for a way out, so that the router does not block. Signals the router when
/// the buffer is empty, takes a message and forwards it (figure 4.13).
void sender(Channel<Signal>& sender_to_main, Channel<Task>& from_main, Channel<Task>& destination);

/// Forwards each task to a free sender, chosen in rotation (figure 4.14). Sends messages for all
/// workers to every sender.
void data_router(Channel<Task>& from_left, std::span<Channel<Signal>* const> from_sender,
                 std::span<Channel<Task>* const> into_sender);

/// Merges the results of the application and of the child workers into one channel towards the
/// coordinator (figure 4.12).
void results_router(std::span<Channel<Answer>* const> inputs, Channel<Answer>& output);

/// Scene, parameters and costs of a worker's tasks.
struct Kernel {
  const renderer::Scene& scene;
  const renderer::Params& params;
  kernels::KernelCost ray, block;
  kernels::RecordBytes bytes;
  kernels::ByModel<kernels::MessageCosts> message;
  std::map<int, std::uint64_t> done = {};  ///< number of tasks, by id of the processor
  renderer::BlockBuffer scratch = {};
};

/// Finds the first intersection of each ray, or renders blocks of pixels. Executes the kernel on
/// the host, and charges its work to the processor.
void application(Kernel& kernel, Channel<Task>& from_router, Channel<Answer>& results);

}  // namespace farm
