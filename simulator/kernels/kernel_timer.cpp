#include "simulator/kernels/kernel_timer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "renderer/scene/generators.hpp"
#include "renderer/trace/intersect.hpp"
#include "renderer/trace/shade.hpp"

namespace kernels {

namespace {

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

// Median time of `times` calls of `run` in seconds. Includes the time of reading the clock.
template <class Run>
double time_often(int times, Run run) {
  std::vector<double> all;
  for (int i = 0; i < times; ++i) {
    const double start_s = host_cpu_s();
    run();
    all.push_back(host_cpu_s() - start_s);
  }
  return median(std::move(all));
}

// Makes the yardstick: a function that traces 1000 primary rays through 800 spheres.
std::function<void()> make_yardstick() {
  const auto scene = std::make_shared<const renderer::Scene>(renderer::make_spheres(800));
  renderer::Params params;
  params.width = params.height = 40;
  std::vector<renderer::Ray> rays;
  for (int y = 8; y < 33; ++y)
    for (int x = 0; x < 40; ++x) rays.push_back(make_primary(scene->view, params, x, y));
  return [scene, rays = std::move(rays), work = renderer::Work()]() mutable {
    for (const auto& ray : rays) intersect(*scene, ray, renderer::Traversal::exhaustive, work);
  };
}

// Mean time in seconds of calling one stored function (replay) that only reads its data. Its data
// is as large as that of a ray with its hit. `interval_s` is the time of reading the clock.
double measure_call(double interval_s) {
  Replays batch;
  double sum = 0;
  for (int i = 0; i < 1000; ++i)
    batch.add([held = std::array<double, 24>{}, &sum] { sum += held[0] + held[12]; });
  const double all_s = time_often(101, [&] { batch.run(); });
  return std::max(0.0, all_s - interval_s) / static_cast<double>(batch.size());
}

Host measure_host() {
  Host host{&host_cpu_s, make_yardstick()};
  host.interval_s = clock_interval_s();
  host.call_s = measure_call(host.interval_s);
  host.yardstick_s = time_often(101, host.yardstick) - host.interval_s;
  return host;
}

}  // namespace

double host_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double clock_interval_s() {
  static const double interval_s = time_often(1001, [] {});
  return interval_s;
}

const Host& this_host() {
  static const Host host = measure_host();
  return host;
}

void KernelTimer::measure() {
  const double batch_s = eval_batch_s(std::max(time_batch(1), 1e-9));
  owed_s_ += batch_s - std::exchange(batch_about_s_, 0);
  longest_batch_s_ = std::max(longest_batch_s_, batch_s);
  most_calls_ = std::max(most_calls_, batch_.size());
  s_per_weight_ = batch_s / weight_;
  batch_.clear();
  weight_ = 0;
  full_ = std::min(4 * full_, MOST_CALLS);
}

double KernelTimer::charge(double about_s) {
  if (batch_.size() == 0)
    owed_s_ -= about_s;  // the call completed a batch, whose measured time includes this call
  else
    batch_about_s_ += about_s;
  const double part_s = std::clamp(owed_s_, -0.2 * about_s, 0.2 * about_s);
  owed_s_ -= part_s;
  return about_s + part_s;
}

// Returns the time of calling all functions of the batch once, in seconds. `once_s` is a rough
// estimate of this time.
double KernelTimer::eval_batch_s(double once_s) const {
  const int passes = static_cast<int>(std::clamp(std::ceil(least_s() / once_s), 1.0, 1e6));
  std::vector<double> in_yardsticks;
  double before_s = time_yardstick();
  for (int i = 0; i < REPEATS; ++i) {
    run_batch(1);
    const double s = time_batch(passes);
    const double after_s = time_yardstick();
    in_yardsticks.push_back(s / (0.5 * (before_s + after_s)));
    before_s = after_s;
  }
  const double s = median(std::move(in_yardsticks)) * host_.yardstick_s / passes;
  return std::max(0.0, s - static_cast<double>(batch_.size()) * host_.call_s);
}

double KernelTimer::time(const std::function<void()>& run) const {
  const double start_s = host_.now_s();
  run();
  return std::max(host_.now_s() - start_s - host_.interval_s, 0.0);
}

void KernelTimer::run_batch(int passes) const {
  for (int pass = 0; pass < passes; ++pass) batch_.run();
}

double KernelTimer::time_batch(int passes) const {
  return time([&] { run_batch(passes); });
}

// Runs the yardstick twice and times the second run. The first run brings caches and branch
// predictors into a known state. Batches are timed in the same way.
double KernelTimer::time_yardstick() const {
  host_.yardstick();
  return time(host_.yardstick);
}

}  // namespace kernels
