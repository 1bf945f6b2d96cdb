#pragma once
// The application of a worker (AP; thesis, 5.1.3): traces the shading trees of sample points.
#include "simulator/iirra/shared.hpp"

namespace iirra {

class Sampler {
 public:
  /// `serve` is called before each ray and handles the messages that may not wait.
  Sampler(Shared& shared, shared_memory::DataManager& manager, std::function<void()> serve);

  /// Makes the sample of a point and traces its primary ray.
  void begin(const Point& point);
  /// Traces the waiting rays of sample number `pass` of a point that have this tree level and are
  /// within the limits.
  void deepen(const Point& point, int pass, int level, const Limits& limits);
  /// Traces the whole shading tree of a point to measure its time. Keeps no sample.
  void measure(const Point& point);

  SampleTable& samples() { return samples_; }
  /// True during begin() and deepen() for this point, when its sample is incomplete.
  bool is_open(const Point& point) const { return open_ == point; }

 private:
  void trace(Sample& sample, const renderer::Ray& ray, bool is_outside);
  void extend(Sample& sample, const Point& point);
  int find_wanted(Sample& sample, const Point& point);
  Traced shoot(Sample& sample, const renderer::Ray& ray, bool is_outside);

  Shared& shared_;
  shared_memory::DataManager& manager_;
  const Params& params_;
  const Sizes& sizes_;
  const std::function<void()> serve_;
  SampleTable samples_;
  std::unordered_map<std::uint32_t, std::uint32_t> corners_;  // objects at corners of pixels
  std::optional<Point> open_;                                 // point of the current sample
};

}  // namespace iirra
