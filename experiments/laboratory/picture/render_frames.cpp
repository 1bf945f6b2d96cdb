#include "experiments/laboratory/picture/render_frames.hpp"

#include <cmath>
#include <filesystem>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/options/options.hpp"
#include "experiments/laboratory/setup/open_scene.hpp"
#include "renderer/image/animation.hpp"

namespace laboratory {
namespace {

constexpr int MAX_FRAME = 999'999;

struct Range {
  int first = 0, last = 0;
  std::size_t count() const { return static_cast<std::size_t>(last - first) + 1; }
};

Range parse_range(const std::string& text) {
  const auto dash = std::min(text.find('-'), text.size());
  const auto first = base::parse_number<int>(text.substr(0, dash));
  const auto last = base::parse_number<int>(text.substr(std::min(dash + 1, text.size())));
  require_option(
      first && last && *first >= 0 && *last >= *first && *last <= MAX_FRAME, "--frames",
      "found \"{}\", expected A-B, such as 0-24: the first and the last frame, from 0 to {}", text,
      MAX_FRAME);
  return {*first, *last};
}

// Duration of frame `n` of an animation in whole ms; n counts from 0. The durations are rounded so
// that each frame starts within half a millisecond of its exact time.
int get_duration_ms(int n, double rate) {
  const auto at = [&](int frame) { return std::lround(1000 * frame / rate); };
  return static_cast<int>(at(n + 1) - at(n));
}

// Limit in bytes on all frames of an animation, which are kept in memory until it is written.
constexpr std::size_t MAX_ANIMATION = std::size_t{1} << 31;

void check_webp(const renderer::Params& params, const Range& range) {
  require_option(std::max(params.width, params.height) <= renderer::MAX_WEBP_SIDE, "--size",
                 "found {} x {}, expected at most {} pixels on each side in a .webp file",
                 params.width, params.height, renderer::MAX_WEBP_SIDE);
  const std::size_t frame = std::size_t{3} * static_cast<std::size_t>(params.width) *
                            static_cast<std::size_t>(params.height);
  require_option(
      range.count() <= MAX_ANIMATION / frame, "--frames",
      "found {} frames of {} x {} pixels, expected at most {} of them in a .webp file (or "
      "-o NAME.png)",
      range.count(), params.width, params.height, MAX_ANIMATION / frame);
}

std::string name_frame(const RenderTask& task, int frame) {
  const std::filesystem::path output = task.output;
  return (output.parent_path() /
          fmt::format("{}-{:04}{}", output.stem().string(), frame, extension_of(task.encoding)))
      .string();
}

// Loads all frames of the scene once, to find errors in them before the rendering starts. Checks
// that no image would replace a file that the scene was read from.
void check_frames(const RenderTask& task, const Range& range) {
  base::check_no_input(task.output);
  for (int frame = range.first; frame <= range.last && !was_interrupted(); ++frame) {
    base::check_no_input(name_frame(task, frame));
    if (frame > range.first) renderer::load_scene(task.scene, frame);
  }
}

}  // namespace

void add_frames_options(CLI::App& command, FramesOptions& o) {
  auto* frames = command.add_option("--frames", o.frames,
                                    "frames A-B of an animation as images NAME-0001.png ...; with "
                                    "-o NAME.webp also as one animation");
  frames->option_text("A-B");
  bind_options<FramesOptions>(
      command,
      {base::Declare<FramesOptions>::number("frame_rate", &FramesOptions::rate, 1, 1000, "",
                                            "frames per second of the animation")},
      o);
  command.get_option("--frame-rate")->needs(frames);
  command.add_flag("--yes", o.is_confirmed, "render the frames even if that takes minutes")
      ->needs(frames);
  for (const char* name : {"--progressive", "--preview", "--stats", "--samples-map", "--order",
                           "--budget", "--state", "--resume", "--key-images"})
    frames->excludes(command.get_option(name));
}

void render_frames(const FramesOptions& o, const RenderTask& task) {
  const Range range = parse_range(o.frames);
  const std::filesystem::path output = task.output;
  const bool is_animation = output.extension() == ".webp";
  if (is_animation) {
    check_webp(task.params, range);
    base::check_can_save(output);
  }
  base::check_can_save(name_frame(task, range.first));
  const InterruptGuard guard;  // delays interrupts until all files are written
  const auto render_frame = [&](const renderer::Scene& scene) {
    return renderer::render(scene, task.params, task.threads,
                            [](int, int) { return !was_interrupted(); });
  };
  Clock clock;
  auto image = render_frame(open_scene(task.scene, range.first));
  if (!was_interrupted()) announce_cost("--frames", range.count(), clock.lap(), o.is_confirmed);
  check_frames(task, range);

  Progress bar("rendering");
  std::vector<renderer::Frame> animation;
  std::size_t frames_done = 0;
  for (int frame = range.first; frame <= range.last; ++frame) {
    if (frame > range.first) image = render_frame(renderer::load_scene(task.scene, frame));
    if (was_interrupted()) break;
    save_image(name_frame(task, frame), image.samples, task.encoding);
    if (is_animation)
      animation.push_back(
          {encode(image.samples, task.encoding), get_duration_ms(frame - range.first, o.rate)});
    bar.show(++frames_done, range.count());
  }
  if (!animation.empty()) renderer::save_webp(task.output, animation);
  if (frames_done < range.count())
    throw Failure(
        fmt::format("interrupted; {} of {} frames are written", frames_done, range.count()),
        EXIT_INTERRUPTED);
}

}  // namespace laboratory
