#pragma once
// Record of a run. It is outside the simulated machine, so that writing it takes no simulated time.
#include "simulator/iirra/tasks/tasks.hpp"
#include "simulator/ray_tracing/rendering.hpp"

namespace iirra {

struct Counts {
  std::uint64_t samples = 0;          ///< number of samples computed
  std::uint64_t samples_outside = 0;  ///< samples outside the image, used only for interpolation
  /// Samples found in the processor's table instead of being traced again.
  std::uint64_t samples_shared = 0;
  std::uint64_t cells_divided = 0;
  std::uint64_t requests = 0;  ///< messages that request tasks; forwarding one counts again
  std::uint64_t refusals = 0;  ///< replies that say that there are no tasks to give
  std::uint64_t moves = 0;     ///< messages that carry tasks, except the initial distribution
  std::uint64_t tasks_moved = 0, bytes_moved = 0;
  std::uint64_t reports = 0;  ///< progress messages from workers without tasks to the coordinator
  /// Numbers of polls by the display, of messages with pictures, and of painted blocks in these
  /// messages; total length of these messages in bytes.
  std::uint64_t polls = 0, pictures = 0, blocks = 0, picture_bytes = 0;
  /// Maximum number of tasks held by a worker.
  std::size_t tasks_most = 0;
  std::uint64_t task_messages() const { return requests + refusals + moves; }
};

/// The record of a run. `rays` counts the rays traced by all processors; `samples` has the sums of
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
  double interactive_s = 0;          ///< duration of the interactive phases that have ended
  double last_task_s = 0;            ///< date in seconds at which a worker last took a task
  /// For each order of the user: when it arrived, and when it first changed a pixel (empty until
  /// then), in seconds since the coordinator began.
  std::vector<std::pair<double, std::optional<double>>> orders_s;
  observe::Use before, after;

  /// Stores the final sums of a pixel. `of_pixel` are the numbers of rays that were traced for it.
  /// Throws base::InvariantBroken if the pixel has already been finished.
  void finish(int x, int y, const renderer::Samples::Sums& sums,
              const renderer::RayCounts& of_pixel);
};

}  // namespace iirra
