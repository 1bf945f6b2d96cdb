#pragma once
// Messages between the processes of IIRRA, carried by routers.
#include <variant>

#include "simulator/iirra/tasks.hpp"
#include "simulator/kernels/kernels.hpp"
#include "simulator/shared_memory/data_manager.hpp"

namespace iirra {

/// Second level of the addresses.
constexpr int TASK_PROCESS = shared_memory::FIRST_FREE_PROCESS;  ///< task managers of the workers
                                                                 ///< and of the coordinator
constexpr int DISPLAY_PROCESS = TASK_PROCESS + 1;

// --- tasks ------------------------------------------------------------------------------------
/// Cells assigned to the receiver.
struct Tasks {
  std::vector<MovedCell> cells;
  std::size_t load = 0;  ///< tasks left at the sender
};
/// Request for tasks. The sender may have forwarded it for another worker, `asker`.
struct TaskRequest {
  int asker = 0;
  bool is_last = false;  ///< last hop: the receiver keeps the request until it has tasks
};
struct NoTasks {
  std::size_t load = 0;
};
/// Cells to measure by one sample each; the receiver does not keep them.
struct Measure {
  std::vector<SampledCell> cells;
};
struct CellTimes {
  std::vector<std::pair<SampledCell, double>> times_s;
};

// --- phases -----------------------------------------------------------------------------------
/// Coordinator -> workers: new limits. The workers reclassify all their cells.
struct NewPhase {
  std::uint32_t phase = 0;
  Limits limits;
  int order = 0;  ///< number of the user's order that set them; 0: none
};
/// Worker -> coordinator: number of pixels newly parked or finished in this phase. See
/// docs/manual/termination.md.
struct Report {
  std::uint32_t phase = 0;
  std::uint64_t parked = 0, finished = 0;
};
struct Stop {};
/// The user's order at this index of Shared::orders is due.
struct UserOrder {
  std::size_t place = 0;
};

// --- display ----------------------------------------------------------------------------------
/// A part of a cell's virtual frame buffer.
struct Painted : renderer::progressive::Painting {
  TaskCell cell;
  int order = 0;  ///< the user's order in force when it was painted
};
struct Poll {};
struct Picture {
  std::vector<Painted> blocks;
  bool is_all = true;  ///< nothing is left to send
};
struct PictureShown {};  ///< acknowledges an unrequested picture
struct KeepPicture {     ///< keeps the picture; with polling after the next round
  std::string name;      ///< file name; counts as one word in the message
};
struct Finish {};  ///< the display shows everything, then replies Finished
struct Finished {};

struct IirraMessage : network::Contents {
  using Content =
      std::variant<Tasks, TaskRequest, NoTasks, Measure, CellTimes, NewPhase, Report, Stop,
                   UserOrder, Poll, Picture, PictureShown, KeepPicture, Finish, Finished>;
  explicit IirraMessage(Content content) : content(std::move(content)) {}
  Content content;
};

/// Sizes of stored and sent data, in bytes, from the model.
struct Sizes {
  explicit Sizes(const machine::Model& model)
      : cell(get_bytes(model, "cell")),
        sample(get_bytes(model, "cell_sample")),
        ray(get_bytes(model, "ray")),
        pixel(get_bytes(model, "pixel")),
        message(model, &kernels::message_costs) {}
  std::uint64_t cell, sample, ray;
  std::uint64_t pixel;  ///< per sample of an adaptive pixel, until it is complete
  kernels::ByModel<kernels::MessageCosts> message;  ///< cycles, not bytes

  static constexpr std::uint64_t WORD = 4;
  std::uint64_t of(const Sample& s) const {
    return sample + ray * s.waiting.size() + pixel * s.open.samples.size();
  }
  std::uint64_t of(const MovedCell& moved) const {
    std::uint64_t sum = cell;
    for (const auto& s : moved.samples) sum += of(s);
    return sum;
  }
  /// A block of a picture: three words of position and age, and three bytes a pixel.
  static std::uint64_t of(const Painted& block) { return 3 * WORD + block.rgb8.size(); }
  std::uint64_t of(const Tasks& tasks) const;
  std::uint64_t of(const Picture& picture) const;
  std::uint64_t of(const IirraMessage::Content& content) const;
};

/// Sends through `manager`'s client as process `from`, which gets undeliverable messages back.
void send(shared_memory::DataManager& manager, const Sizes& sizes, int from, network::Address to,
          IirraMessage::Content content);
/// Content of a message. Throws machine::Fault, naming both ends, if it was returned.
const IirraMessage::Content& read(const Sizes& sizes, const network::Message& message);

}  // namespace iirra
