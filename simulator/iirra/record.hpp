#pragma once
// Record of a run, kept outside the simulated machine, so that it takes no simulated time.
#include "simulator/iirra/tasks/tasks.hpp"
#include "simulator/ray_tracing/rendering.hpp"

namespace iirra {

struct Counts {
  std::uint64_t samples = 0;          ///< number of samples computed
  std::uint64_t samples_outside = 0;  ///< samples outside the image, used only for interpolation
  std::uint64_t samples_shared = 0;   ///< samples reused by another cell of the processor
  std::uint64_t cells_divided = 0;
  std::uint64_t requests = 0;  ///< messages that request tasks, including forwarded ones
  std::uint64_t refusals = 0;  ///< replies without tasks
  std::uint64_t moves = 0;     ///< messages with tasks, except the initial distribution
  std::uint64_t tasks_moved = 0, bytes_moved = 0;
  std::uint64_t reports = 0;  ///< messages from workers without tasks to the coordinator
  /// Polls and pictures of the display.
  std::uint64_t polls = 0, pictures = 0, blocks = 0, picture_bytes = 0;
  /// Maximum number of tasks held by a worker.
  std::size_t tasks_most = 0;
  std::uint64_t task_messages() const { return requests + refusals + moves; }
};

/// The record of a run. `rays` counts the rays of all processors; `samples` holds the sums of
/// finished pixels.
struct Record : ray_tracing::Rendering {
  explicit Record(const renderer::Params& image) : finished(0) {
    samples = renderer::Samples(image.width, image.height);
    finished.resize(samples.sums.size());
  }

  Counts counts;
  renderer::RayCounts rays_outside;  ///< rays of samples outside the image
  renderer::RayCounts rays_image;    ///< rays of the final image
  std::vector<bool> finished;        ///< true for finished pixels, by pixel
  double begun_s = 0, ended_s = 0;   ///< in seconds since the machine's start
  double interactive_s = 0;
  double last_task_s = 0;  ///< date in seconds at which a worker last took a task
  /// For each order of the user: when it arrived and when the first pixel changed, in seconds since
  /// the first task.
  std::vector<std::pair<double, std::optional<double>>> orders_s;
  observe::Use before, after;

  /// Stores the final sums of a pixel, for which the rays `of_pixel` were traced. Throws
  /// base::InvariantBroken if the pixel was finished before.
  void finish(int x, int y, const renderer::Samples::Sums& sums,
              const renderer::RayCounts& of_pixel);
};

}  // namespace iirra
