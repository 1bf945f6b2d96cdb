#pragma once
// What is noted of a run from outside of the machine: it costs no simulated time.
#include "simulator/iirra/tasks.hpp"
#include "simulator/tracing/rendering.hpp"

namespace iirra {

struct Counts {
  std::uint64_t samples = 0;          ///< computed
  std::uint64_t samples_outside = 0;  ///< of them, beyond the image: for interpolation only
  std::uint64_t samples_shared = 0;  ///< needed by a second cell of a processor: not computed again
  std::uint64_t cells_divided = 0;
  std::uint64_t requests = 0;  ///< messages for tasks: requests and those passed on,
  std::uint64_t refusals = 0;  ///< answers without tasks,
  std::uint64_t moves = 0;     ///< and messages with tasks, except the first ones
  std::uint64_t tasks_moved = 0, bytes_moved = 0;
  std::uint64_t reports = 0;  ///< of workers without tasks to the coordinator
  std::uint64_t polls = 0, pictures = 0, blocks = 0, picture_bytes = 0;  ///< to the display
  std::size_t tasks_most = 0;                                            ///< that a worker held
  std::uint64_t task_messages() const { return requests + refusals + moves; }
};

/// Its `rays` are those of all processors; its `samples` the sums of the pixels that are finished.
struct Record : tracing::Rendering {
  explicit Record(const renderer::Params& image) : finished(0) {
    samples = renderer::Samples(image.width, image.height);
    finished.resize(samples.sums.size());
  }

  Counts counts;
  renderer::RayCounts rays_outside;  ///< of samples beyond the image
  renderer::RayCounts rays_image;    ///< that the image is made of
  std::vector<bool> finished;        ///< pixels
  double begun_s = 0, ended_s = 0;   ///< since the machine was started
  double interactive_s = 0;
  double last_task_s = 0;  ///< when a worker took a task for the last time
  /// When each order of the user came, and reached a pixel; from the first task.
  std::vector<std::pair<double, std::optional<double>>> orders_s;
  observe::Use before, after;

  /// A pixel has its last colour, which `of_pixel` rays were traced for. Throws
  /// base::InvariantBroken if it was finished before.
  void finish(int x, int y, const renderer::Samples::Sums& sums,
              const renderer::RayCounts& of_pixel);
};

}  // namespace iirra
