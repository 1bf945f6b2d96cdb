#pragma once
// The application of a worker (AP; thesis, 5.1.3): traces the rays that start at sample points, and
// their trees of child rays (shading trees).
#include "simulator/iirra/shared.hpp"

namespace iirra {

class Sampler {
 public:
  /// Before each ray calls `serve`, which handles the messages that cannot wait until the sample is
  /// complete.
  Sampler(Shared& shared, shared_memory::DataManager& manager, std::function<void()> serve);

  /// Makes the sample at a point and traces its primary ray.
  void begin(const Point& point);
  /// Traces the waiting rays that belong to sample number `pass` of the point, have this level in
  /// their shading tree, and are within the limits.
  void deepen(const Point& point, int pass, int level, const Limits& limits);
  /// Traces the whole shading tree of a point without storing a sample, so that the caller can
  /// measure its time.
  void measure(const Point& point);

  SampleTable& samples() { return samples_; }
  /// True while begin() or deepen() works on this point, so that its sample is incomplete.
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
  // Number of the object seen at each known corner of pixels.
  std::unordered_map<std::uint32_t, std::uint32_t> corners_;
  std::optional<Point> open_;  // point on which begin() or deepen() works
};

}  // namespace iirra
