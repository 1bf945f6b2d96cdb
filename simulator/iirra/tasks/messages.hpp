#pragma once
// Messages between the processes of IIRRA, carried by routers.
#include <variant>

#include "simulator/iirra/tasks/tasks.hpp"
#include "simulator/kernels/kernels.hpp"
#include "simulator/shared_memory/data_manager.hpp"

namespace iirra {

/// Process numbers in addresses.
constexpr int TASK_PROCESS = shared_memory::FIRST_FREE_PROCESS;  ///< task managers
constexpr int DISPLAY_PROCESS = TASK_PROCESS + 1;

// --- tasks ------------------------------------------------------------------------------------
/// Cells that become tasks of the receiver.
struct Tasks {
  std::vector<MovedCell> cells;
  std::size_t load = 0;  ///< number of tasks left at the sender
};
/// A request for tasks of worker `asker`, which need not be the sender.
struct TaskRequest {
  int asker = 0;
  bool is_last = false;  ///< the receiver must remember the request until it has tasks
};
struct NoTasks {
  std::size_t load = 0;
};
/// Cells whose time the receiver shall measure with one sample each. It does not keep these cells.
struct Measure {
  std::vector<SampledCell> cells;
};
struct CellTimes {
  std::vector<std::pair<SampledCell, double>> times_s;
};

// --- phases -----------------------------------------------------------------------------------
/// Coordinator -> workers: new limits, by which workers reclassify all cells.
struct NewPhase {
  std::uint32_t phase = 0;
  Limits limits;
  int order = 0;  ///< number of the user's order that set the limits, or 0
};
/// Worker -> coordinator: pixels that were parked or finished in this phase since the last report.
/// See docs/manual/termination.md.
struct Report {
  std::uint32_t phase = 0;
  std::uint64_t parked = 0, finished = 0;
};
struct Stop {};
/// Message that an order of the user is due, given by its index in Shared::orders.
struct UserOrder {
  std::size_t place = 0;
};

// --- display ----------------------------------------------------------------------------------
/// A painted part of a cell, from a virtual frame buffer.
struct Painted : renderer::progressive::Painting {
  TaskCell cell;
  int order = 0;  ///< the user's order that was in force when it was painted
};
struct Poll {};
struct Picture {
  std::vector<Painted> blocks;
  bool is_all = true;  ///< no further blocks are waiting
};
struct PictureShown {};  ///< acknowledges an unrequested picture
struct KeepPicture {     ///< saves the picture; with polling, after the next round
  std::string name;      ///< file name; counts as one word of the message
};
struct Finish {};  ///< the display must show all pictures, then reply Finished
struct Finished {};

using IirraMessage =
    std::variant<Tasks, TaskRequest, NoTasks, Measure, CellTimes, NewPhase, Report, Stop, UserOrder,
                 Poll, Picture, PictureShown, KeepPicture, Finish, Finished>;

/// Sizes of stored and transmitted data in bytes, from the model.
struct Sizes {
  explicit Sizes(const machine::Model& model)
      : cell(get_bytes(model, "cell")),
        sample(get_bytes(model, "cell_sample")),
        ray(get_bytes(model, "ray")),
        pixel(get_bytes(model, "pixel")),
        message(model, &kernels::message_costs) {}
  std::uint64_t cell, sample, ray;
  std::uint64_t pixel;                              ///< per sample of an incomplete adaptive pixel
  kernels::ByModel<kernels::MessageCosts> message;  ///< in cycles, not bytes

  static constexpr std::uint64_t WORD = 4;
  std::uint64_t of(const Sample& s) const {
    return sample + ray * s.waiting.size() + pixel * s.open.samples.size();
  }
  std::uint64_t of(const MovedCell& moved) const {
    std::uint64_t sum = cell;
    for (const auto& s : moved.samples) sum += of(s);
    return sum;
  }
  /// A block of a picture: three words for position and age, then three bytes per pixel.
  static std::uint64_t of(const Painted& block) { return 3 * WORD + block.rgb8.size(); }
  std::uint64_t of(const Tasks& tasks) const;
  std::uint64_t of(const Picture& picture) const;
  std::uint64_t of(const IirraMessage& content) const;
};

/// Sends a message through `manager`'s client. If the message cannot be delivered, process `from`
/// gets it back.
void send(shared_memory::DataManager& manager, const Sizes& sizes, int from, network::Address to,
          IirraMessage content);
/// The content of a message. If the message was returned as undeliverable, throws machine::Fault
/// that names both ends.
const IirraMessage& read(const Sizes& sizes, const network::Message& message);

}  // namespace iirra
