#pragma once
// The processes of a worker (thesis, 4.3.6.2): a data router with a sender for each way out, a
// results router ("gatherer"), both at high priority, and the application at low priority.
#include <span>
#include <vector>

#include "simulator/farm/messages.hpp"

namespace farm {

/// Keeps its router from blocking on one way out: says that it is free, takes a message and waits
/// for the way out (figure 4.13).
void sender(Channel<Signal>& sender_to_main, Channel<Task>& from_main, Channel<Task>& destination);

/// Pushes tasks ahead to any sender that is free, in fair turns (figure 4.14); what is for all
/// workers, to every one.
void data_router(Channel<Task>& from_left, std::span<Channel<Signal>* const> from_sender,
                 std::span<Channel<Task>* const> into_sender);

/// Multiplexes the results of the application and of the workers behind onto one way back
/// (figure 4.12).
void results_router(std::span<Channel<Answer>* const> inputs, Channel<Answer>& output);

/// What a worker needs for its tasks: its copy of the scene, and what they cost.
struct Kernel {
  const renderer::Scene& scene;
  const renderer::Params& params;
  kernels::KernelCost ray, block;
  kernels::RecordBytes bytes;
  kernels::ByModel<kernels::MessageCosts> message;
  std::map<int, std::uint64_t> done = {};  ///< tasks, by the processor's id
  renderer::BlockBuffer scratch = {};
};

/// Finds the first intersection of each ray it is given, or all that a block of pixels shows. The
/// kernel really runs; what it did is charged to the processor.
void application(Kernel& kernel, Channel<Task>& from_router, Channel<Answer>& results);

}  // namespace farm
