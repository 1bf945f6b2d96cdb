#pragma once
// What is noted of a run from outside of the machine: it costs no simulated time.
#include "renderer/trace/render.hpp"
#include "simulator/growth/recorder.hpp"
#include "simulator/iirra/tasks.hpp"
#include "simulator/observe/use.hpp"

namespace iirra {

/// The picture as it was when a stage ended, or at an order of the user's.
struct KeyImage {
  double at_s = 0;  ///< from the first task
  std::string name;
  std::vector<std::uint8_t> rgb8;
};

struct Counts {
  std::uint64_t samples = 0;          ///< computed
  std::uint64_t samples_outside = 0;  ///< of them, beyond the image: for interpolation only
  std::uint64_t samples_shared = 0;   ///< needed by a second cell of a processor: not computed again
  std::uint64_t cells_divided = 0;
  std::uint64_t requests = 0;  ///< messages for tasks: requests and those passed on,
  std::uint64_t refusals = 0;  ///< answers without tasks,
  std::uint64_t moves = 0;     ///< and messages with tasks, except the first ones
  std::uint64_t tasks_moved = 0, bytes_moved = 0;
  std::uint64_t reports = 0;   ///< of workers without tasks to the coordinator
  std::uint64_t polls = 0, pictures = 0, blocks = 0, picture_bytes = 0;  ///< to the display
  std::uint64_t looks = 0;     ///< of workers at the network, between samples
  std::size_t tasks_most = 0;  ///< that a worker held
  std::uint64_t task_messages() const { return requests + refusals + moves; }
};

struct Record {
  Record(int width, int height) : image(width, height), finished(image.sums.size()) {}

  Counts counts;
  renderer::RayCounts rays;          ///< traced, on all processors
  renderer::RayCounts rays_outside;  ///< of them, of samples beyond the image
  renderer::RayCounts rays_image;    ///< that the image is made of
  renderer::Samples image;           ///< sums of the pixels that are finished
  std::vector<bool> finished;
  std::uint64_t pixels_finished = 0;

  double begun_s = 0, ended_s = 0;  ///< since the machine was started
  double interactive_s = 0;
  double last_task_s = 0;  ///< when a worker took a task for the last time
  std::vector<std::pair<std::string, double>> stage_ends_s;  ///< from the first task
  std::vector<std::pair<double, std::optional<double>>> orders_s;  ///< came, and reached a pixel
  bool is_aborted = false;
  std::vector<std::string> notes;
  std::vector<std::uint8_t> rgb8;  ///< the display's picture
  std::vector<KeyImage> key_images;
  std::vector<growth::Shown> pictures, growth;
  observe::Use before, after;

  double time_s() const { return ended_s - begun_s; }
  /// A pixel has its last colour, of a sample whose rays are `of_sample`. Throws
  /// base::InvariantBroken if it was finished before.
  void finish(int x, int y, const Sample& sample);
};

}  // namespace iirra
