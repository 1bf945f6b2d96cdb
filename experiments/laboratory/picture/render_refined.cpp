#include "experiments/laboratory/picture/render_refined.hpp"

#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/options/options.hpp"
#include "experiments/laboratory/picture/refinement_file.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;
using renderer::progressive::Order;
using renderer::progressive::Refinement;

constexpr double KEY_PERCENTS[] = {1, 5, 25, 100};
// writes a state at each multiple of this share of the samples
constexpr double STATE_PERCENT = 5;
// longest time between two states, even if the share has not been reached
constexpr double STATE_SECONDS = 2;
// largest share of the time that may be spent on writing states
constexpr double STATE_SHARE = 0.05;
// desired time between two checks of the clock and of interrupts
constexpr double STEP_SECONDS = 0.05;

std::uint64_t samples_at(double percent, std::uint64_t all) {
  return static_cast<std::uint64_t>(std::ceil(percent / 100 * static_cast<double>(all)));
}

Budget parse_budget(const std::string& text) {
  Budget budget;
  const auto number =
      text.empty() ? std::nullopt
                   : base::parse_number<double>(std::string_view(text).substr(0, text.size() - 1));
  const bool is_percent = text.ends_with('%');
  require_option(
      number && *number > 0 && std::isfinite(*number) &&
          (is_percent ? *number <= 100 : text.ends_with('s')),
      "--budget",
      "found \"{}\", expected a percentage of the samples, above 0 and up to 100, such as "
      "5%, or seconds above 0, such as 10s",
      text);
  if (is_percent)
    budget.percent = *number;
  else
    budget.seconds = *number;
  return budget;
}

// Writes successive states of a rendering to one file.
class StateFile {
 public:
  StateFile(std::string path, Identity identity)
      : path_(std::move(path)), identity_(std::move(identity)) {
    if (!path_.empty()) base::check_can_save(path_);
  }
  void add_stops(std::set<std::uint64_t>& stops, std::uint64_t total) const {
    if (path_.empty()) return;
    for (double percent = STATE_PERCENT; percent < 100; percent += STATE_PERCENT)
      stops.insert(samples_at(percent, total));
  }
  void save(const Refinement& image) {
    if (path_.empty() || image.done() == saved_) return;
    clock_.lap();
    save_state(path_, identity_, image.state());
    last_cost_s_ = clock_.lap();
    saved_ = image.done();
    since_s_ = 0;
  }
  /// Saves a state if more than `seconds` have passed since the last one. If writing is slow, waits
  /// longer, so that writing takes at most STATE_SHARE of the time.
  void save_after(double seconds, const Refinement& image) {
    since_s_ += clock_.lap();
    if (since_s_ > std::max(seconds, last_cost_s_ / STATE_SHARE)) save(image);
  }

 private:
  const std::string path_;
  const Identity identity_;
  Clock clock_;
  double last_cost_s_ = 0, since_s_ = 0;
  std::optional<std::uint64_t> saved_;
};

// Writes the intermediate pictures of a rendering.
class KeyImages {
 public:
  KeyImages(const RenderTask& task, const Refinement& image)
      : folder_(task.key_images), encoding_(task.encoding) {
    if (folder_.empty()) return;
    make_folder("--key-images", folder_);
    for (const double percent : KEY_PERCENTS)
      names_[samples_at(percent, image.total())] =
          fmt::format("percent-{}{}", percent, extension_of(encoding_));
  }
  void add_stops(std::set<std::uint64_t>& stops) const {
    for (const auto& [samples, name] : names_) stops.insert(samples);
  }
  /// Saves the image if it has reached the sample count of an intermediate picture since the count
  /// `before`.
  void save(const Refinement& image, std::uint64_t before) {
    for (const auto& [samples, name] : names_)
      if (before < samples && image.done() >= samples)
        save_image((fs::path(folder_) / name).string(), image.make_rendering().samples, encoding_);
  }

 private:
  const std::string folder_;
  const ImageEncoding encoding_;
  // file names of the intermediate pictures, by sample count
  std::map<std::uint64_t, std::string> names_;
};

// Number of samples to render between two checks, adapted to the time that they take.
class Pace {
 public:
  explicit Pace(int threads) : samples_(static_cast<std::uint64_t>(threads)) {}
  std::uint64_t samples() const { return samples_; }
  void adapt(double seconds) {
    if (seconds < STEP_SECONDS / 2) samples_ *= 2;
    if (seconds > STEP_SECONDS * 2) samples_ = std::max<std::uint64_t>(1, samples_ / 2);
  }

 private:
  std::uint64_t samples_;
};

Refined finish(Refinement& image, std::uint64_t rays) {
  return {.done = image.done(),
          .all = image.total(),
          .rays = rays,
          .queue_peak = image.queue() ? image.queue()->peak() : 0,
          .interrupted = was_interrupted() && !image.is_finished(),
          .image = image.take_rendering()};
}

std::size_t count_pixels(const renderer::Params& params) {
  return static_cast<std::size_t>(params.width) * static_cast<std::size_t>(params.height);
}

}  // namespace

void add_refined_options(CLI::App& command, RefinedOptions& o) {
  const auto field = renderer::progressive::order_field<Order>(std::identity{});
  add_field_option(
      command, field.name, field.help + "; each pixel first gets one sample, then the others",
      field.domain, field.get(Order::quadrants),
      [&o, field](const base::Scalar& value) { return field.assign(o.order.emplace(), value); });
  command
      .add_option_function<std::string>(
          "--budget", [&o](const std::string& text) { o.budget = parse_budget(text); },
          "end after a share of all samples (5%) or after a time (10s), and save the picture so "
          "far")
      ->option_text("P%|Ts");
  command
      .add_option("--state", o.state,
                  "file for the state of the rendering, saved at intervals and at the end")
      ->check(check_file_name);
  command
      .add_option("--resume", o.resume,
                  "continue from the state in this file, with the other options unchanged; also "
                  "saves states there unless --state is given")
      ->check(check_file_name);
  for (const char* name : {"--order", "--budget", "--state", "--resume"})
    for (const char* other : {"--progressive", "--preview"})
      command.get_option(name)->excludes(command.get_option(other));
}

Refined render_refined(const RefinedOptions& o, const RenderTask& task,
                       const renderer::Scene& scene) {
  const Order order = o.order.value_or(Order::quadrants);
  const auto identity =
      o.state.empty() && o.resume.empty() ? Identity{} : identify(task.scene, task.params, order);
  Refinement image = o.resume.empty()
                         ? Refinement(scene, task.params, order, task.threads)
                         : Refinement(scene, task.params, order, task.threads,
                                      load_state(o.resume, identity, count_pixels(task.params)));
  const Budget budget = o.budget.value_or(Budget{});
  const std::uint64_t goal = samples_at(budget.percent, image.total());
  StateFile states(o.state.empty() ? o.resume : o.state, identity);
  KeyImages keys(task, image);
  std::set<std::uint64_t> stops = {goal};
  keys.add_stops(stops);
  states.add_stops(stops, image.total());
  const std::uint64_t rays_before = image.state().rays.total();
  Progress bar("rendering");
  Pace pace(task.threads);
  double seconds = 0;
  const auto is_stopped = [&] { return was_interrupted() || budget.is_spent(seconds); };
  states.save(image);
  Clock clock;
  for (const std::uint64_t stop : stops) {
    if (stop > goal) break;
    const std::uint64_t before = image.done();
    while (image.done() < stop && !is_stopped()) {
      image.advance(std::min(pace.samples(), stop - image.done()));
      const double step = clock.lap();
      pace.adapt(step);
      states.save_after(STATE_SECONDS, image);
      seconds += step + clock.lap();
      bar.show(image.done(), image.total());
    }
    keys.save(image, before);
    if (is_stopped()) break;
    states.save_after(0, image);
    seconds += clock.lap();
  }
  states.save(image);
  return finish(image, image.state().rays.total() - rays_before);
}

void report_interrupt(const RefinedOptions& o, const RenderTask& task, const Refined& refined) {
  const auto& state = o.state.empty() ? o.resume : o.state;
  throw Failure(fmt::format("interrupted; {} has the picture after {} of {} samples{}", task.output,
                            refined.done, refined.all,
                            state.empty() ? "" : fmt::format("; --resume {} goes on", state)),
                EXIT_INTERRUPTED);
}

}  // namespace laboratory
