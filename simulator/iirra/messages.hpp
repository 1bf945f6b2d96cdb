#pragma once
// What the processes of IIRRA say to each other, over routers.
#include <variant>

#include "simulator/iirra/tasks.hpp"
#include "simulator/kernels/kernels.hpp"
#include "simulator/shared_memory/data_manager.hpp"

namespace iirra {

/// The second level of addresses.
constexpr int TASK_PROCESS = shared_memory::FIRST_FREE_PROCESS;  ///< task managers, workers' and
                                                                 ///< the coordinator's
constexpr int DISPLAY_PROCESS = TASK_PROCESS + 1;

// --- tasks ------------------------------------------------------------------------------------
/// Cells for the receiver.
struct Tasks {
  std::vector<MovedCell> cells;
  std::size_t load = 0;  ///< tasks that the sender has left
};
/// For tasks. `asker` may not be the one that sent it on.
struct TaskRequest {
  int asker = 0;
  bool is_last = false;  ///< of a ring's round: the receiver keeps it until it has tasks
};
struct NoTasks {
  std::size_t load = 0;
};
/// To be measured by a subsample, not to be kept.
struct Measure {
  std::vector<SampledCell> cells;
};
struct CellTimes {
  std::vector<std::pair<SampledCell, double>> times_s;
};

// --- phases -----------------------------------------------------------------------------------
/// Coordinator -> workers: limits from now on. All cells are to be classified again.
struct NewPhase {
  std::uint32_t phase = 0;
  Limits limits;
  int order = 0;  ///< of the user, that has set them; 0: none
};
/// Worker -> coordinator: so many pixels more are in cells that were parked, or are finished, in
/// this phase. See docs/manual/termination.md.
struct Report {
  std::uint32_t phase = 0;
  std::uint64_t parked = 0, finished = 0;
};
struct Stop {};
/// The user's order of this number in Shared::orders has come.
struct UserOrder {
  std::size_t place = 0;
};

// --- display ----------------------------------------------------------------------------------
/// A part of a cell's virtual frame buffer.
struct Painted : renderer::progressive::Painting {
  TaskCell cell;
  int order = 0;  ///< of the user, under which it was painted
};
struct Poll {};
struct Picture {
  std::vector<Painted> blocks;
  bool is_all = true;  ///< nothing is left to be sent
};
struct Shown {};      ///< a picture that was not asked for
struct KeepPicture {  ///< as it is once every worker has been asked
  std::string name;   ///< for a file; a word where it is sent
};
struct Finish {};  ///< tell when everything is shown
struct Finished {};

struct IirraMessage : network::Contents {
  using Content =
      std::variant<Tasks, TaskRequest, NoTasks, Measure, CellTimes, NewPhase, Report, Stop,
                   UserOrder, Poll, Picture, Shown, KeepPicture, Finish, Finished>;
  explicit IirraMessage(Content content) : content(std::move(content)) {}
  Content content;
};

/// Sizes of what is stored and sent, bytes: the model's.
struct Sizes {
  explicit Sizes(const machine::Model& model)
      : cell(get_bytes(model, "cell")),
        sample(get_bytes(model, "cell_sample")),
        ray(get_bytes(model, "ray")),
        pixel(get_bytes(model, "pixel")),
        message(model, &kernels::message_costs) {}
  std::uint64_t cell, sample, ray;
  std::uint64_t pixel;  ///< one of several samples of a pixel, until the last is there
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
  /// A block of a picture: where it is and how new, in three words, and three bytes a pixel.
  static std::uint64_t of(const Painted& block) { return 3 * WORD + block.rgb8.size(); }
  std::uint64_t of(const Tasks& tasks) const;
  std::uint64_t of(const Picture& picture) const;
  std::uint64_t of(const IirraMessage::Content& content) const;
};

/// Sends over the client of `manager`, as the process `from`, to which a message would come back.
void send(shared_memory::DataManager& manager, const Sizes& sizes, int from, network::Address to,
          IirraMessage::Content content);
/// What a message says. Throws machine::Fault, naming both ends, for one that has come back.
const IirraMessage::Content& read(const Sizes& sizes, const network::Message& message);

}  // namespace iirra
