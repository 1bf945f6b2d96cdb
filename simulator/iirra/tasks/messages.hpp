#pragma once
// Messages between the processes of IIRRA, carried by routers.
#include <variant>

#include "simulator/iirra/tasks/tasks.hpp"
#include "simulator/kernels/kernels.hpp"
#include "simulator/shared_memory/data_manager.hpp"

namespace iirra {

/// Numbers of processes in network addresses.
constexpr int TASK_PROCESS = shared_memory::FIRST_FREE_PROCESS;  ///< number of task managers
constexpr int DISPLAY_PROCESS = TASK_PROCESS + 1;

// --- tasks ------------------------------------------------------------------------------------
/// Cells that become tasks of the receiver.
struct Tasks {
  std::vector<MovedCell> cells;
  std::size_t load = 0;  ///< number of tasks that the sender keeps
};
/// Worker `asker` requests tasks. A request may be forwarded, so the sender may be another
/// processor.
struct TaskRequest {
  int asker = 0;
  bool is_last = false;  ///< the receiver must store the request until it has tasks to spare
};
struct NoTasks {
  std::size_t load = 0;
};
/// The receiver measures the time of one sample in each cell. The cells do not become its tasks.
struct Measure {
  std::vector<SampledCell> cells;
};
struct CellTimes {
  std::vector<std::pair<SampledCell, double>> times_s;
};

// --- phases -----------------------------------------------------------------------------------
/// Coordination -> workers: new limits. Each worker compares all its cells with them.
struct NewPhase {
  std::uint32_t phase = 0;
  Limits limits;
  int order = 0;  ///< number of the user's order that set the limits, or 0
};
/// Worker -> coordinator: numbers of pixels that, since the worker's last report in this phase,
/// came to wait beyond the limits (`parked`) or were finished. The manual's page
/// docs/manual/termination.md explains how the coordinator detects the end of a phase.
struct Report {
  std::uint32_t phase = 0;
  std::uint64_t parked = 0, finished = 0;
};
struct Stop {};
/// Tells the coordinator that an order of the user is due. `place` is its index in Shared::orders.
struct UserOrder {
  std::size_t place = 0;
};

// --- display ----------------------------------------------------------------------------------
/// A cell or strip of a cell, painted in a worker's virtual frame buffer.
struct Painted : renderer::progressive::Painting {
  TaskCell cell;
  int order = 0;  ///< number of the user's order in force when the cell was painted, or 0
};
struct Poll {};
struct Picture {
  std::vector<Painted> blocks;
  bool is_all = true;  ///< false if the sender has further blocks
};
struct PictureShown {};  ///< acknowledges a picture that a worker sent unasked
struct KeepPicture {     ///< saves the picture; a display that polls first completes a round
  std::string name;      ///< file name; its simulated length is one word
};
struct Finish {};  ///< the display must show all pictures, then reply with Finished
struct Finished {};

using IirraMessage =
    std::variant<Tasks, TaskRequest, NoTasks, Measure, CellTimes, NewPhase, Report, Stop, UserOrder,
                 Poll, Picture, PictureShown, KeepPicture, Finish, Finished>;

/// Sizes in bytes of records and messages, from the model file.
struct Sizes {
  explicit Sizes(const machine::Model& model)
      : cell(get_bytes(model, "cell")),
        sample(get_bytes(model, "cell_sample")),
        ray(get_bytes(model, "ray")),
        pixel(get_bytes(model, "pixel")),
        message(model, &kernels::message_costs) {}
  std::uint64_t cell, sample, ray;
  std::uint64_t pixel;  ///< bytes for each sample of an incomplete pixel with adaptive sampling
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
  /// Length of a painted block: three words for position and age, then three bytes per pixel.
  static std::uint64_t of(const Painted& block) { return 3 * WORD + block.rgb8.size(); }
  std::uint64_t of(const Tasks& tasks) const;
  std::uint64_t of(const Picture& picture) const;
  std::uint64_t of(const IirraMessage& content) const;
};

/// Sends a message through the router client of `manager`. An undeliverable message returns to
/// process number `from` of this processor.
void send(shared_memory::DataManager& manager, const Sizes& sizes, int from, network::Address to,
          IirraMessage content);
/// Returns the content of a message. If the message came back as undeliverable, throws
/// machine::Fault that names sender and receiver.
const IirraMessage& read(const Sizes& sizes, const network::Message& message);

}  // namespace iirra
