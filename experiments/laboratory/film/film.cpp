#include "experiments/laboratory/film/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/whole_file.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "simulator/observe/timeline.hpp"

namespace laboratory {

namespace {

namespace fs = std::filesystem;
using base::require;
using renderer::Frame;

// Minimum number of samples of the picture for each frame of the film. A frame shows the last
// sample before the frame's time.
constexpr int SNAPSHOTS_A_FRAME = 2;
constexpr double MOST_BYTES = 1e9;  // limit on the memory of all sampled pictures, bytes

bool is_webp(const std::string& file) { return fs::path(file).extension() == ".webp"; }

int duration_ms(int frame, int frames) {
  const int ms = (frame + 1) * FILM_MS / frames - frame * FILM_MS / frames;
  return frame + 1 < frames ? ms : ms + LAST_MS;
}

// Makes and writes one frame at a time, so that memory never holds several frames.
void save_frames(const std::string& file, int count, const renderer::MakeFrame& make) {
  const auto frames = static_cast<std::size_t>(count);
  if (is_webp(file)) return base::save_whole(file, renderer::make_webp(frames, make));
  for (std::size_t i = 0; i < frames; ++i) {
    const auto bitmap = make(i).bitmap;
    renderer::save_png(frame_name(file, i), bitmap.width, bitmap.height, bitmap.rgb8);
  }
}

double busy_share(const std::vector<observe::TimelineRow::Shares>& columns, std::size_t column) {
  if (columns.empty()) return 0;  // no transfer was recorded
  const auto& shares = columns[column];
  return std::clamp(shares[0] + shares[1] + shares[2], 0.0, 1.0);
}

}  // namespace

std::string frame_name(const std::string& file, std::size_t frame) {
  const fs::path path = file;
  return (path.parent_path() / fmt::format("{}-{:04}.png", path.stem().string(), frame + 1))
      .string();
}

std::string describe_files(const std::string& file, int frames) {
  if (is_webp(file)) return file;
  const auto last = static_cast<std::size_t>(frames - 1);
  return fmt::format("{} to {}", frame_name(file, 0), frame_name(file, last));
}

std::string first_file(const std::string& file) {
  if (is_webp(file)) return file;
  require(fs::path(file).extension() == ".png", "--animate",
          "found {}, expected a name that ends in .webp or .png", file);
  return frame_name(file, 0);
}

void check_films(const FilmOptions& options, const Experiment& experiment) {
  const auto& program = *experiment.program;
  require(options.picture.empty() || program.shows_picture, "--animate",
          "found picture, but the program {} shows none, expected network or another program",
          program.name);
  if (options.network.empty()) return;
  require(program.uses.network, "--animate",
          "found network, but the program {} has none, expected a program with a [network]",
          program.name);
  const auto topology = make_workers(experiment);
  require(topology.processors <= topologies::MAX_DRAWN, "--animate",
          "found network with {1} processors ({0}), expected at most {2} in a drawing",
          topology.name, topology.processors, topologies::MAX_DRAWN);
}

PicturePlace place_picture(int width, int height) {
  constexpr int LARGE = 480, GAP = 16;
  const int factor = std::max(1, LARGE / std::max(width, height));
  const int frame = std::max(factor * width + 2 * FRAME_MARGIN, LARGE);
  return {(frame - factor * width) / 2, TITLE_HEIGHT, factor, frame,
          TITLE_HEIGHT + factor * height + GAP + TIME_SCALE_HEIGHT};
}

Film::Film(const FilmOptions& options, const topologies::Topology& network, double from_s)
    : options_(options), network_(network), from_s_(from_s) {}

void Film::begin(const machine::Machine& machine, const observe::ControlPanel& view) {
  if (!options_.picture.empty() && view.picture) {
    const auto [width, height, rgb8] = *view.picture;
    const auto place = place_picture(width, height);
    require(!is_webp(options_.picture) ||
                std::max(place.width, place.height) <= renderer::MAX_WEBP_SIDE,
            "--animate",
            "found a picture of {} x {} pixels, expected at most {} pixels on each side in .webp",
            width, height, renderer::MAX_WEBP_SIDE - 160);
    const double bytes = 6.0 * width * height * SNAPSHOTS_A_FRAME;
    require(bytes * options_.frames <= MOST_BYTES, "--frames",
            "found {} frames of {} x {} pixels, expected at most {:.0f}", options_.frames, width,
            height, MOST_BYTES / bytes);
    picture_ = view.picture;
    width_ = width;
    snapshots::Schedule snapshot_times;
    snapshot_times.growth = SNAPSHOTS_A_FRAME * options_.frames;
    recorder_.emplace(snapshot_times);
  }
  if (options_.network.empty()) return;
  drawing_.emplace(machine, network_, view.network);
  Clock clock;
  const Busy idle{std::vector<double>(machine.processors().size()),
                  std::vector<double>(machine.links().size())};
  const Frame frame{drawing_->draw("", idle, {0, 1}, {0, 1}), 1};
  if (is_webp(options_.network)) renderer::make_webp({&frame, 1});
  announce_cost("--animate", static_cast<std::size_t>(options_.frames), clock.lap(),
                options_.is_confirmed);
}

snapshots::Snapshot Film::look() const { return {.rgb8 = *picture_->rgb8()}; }

void Film::before_change(double now_s) {
  if (recorder_) recorder_->note(now_s - from_s_, [this] { return look(); });
}

void Film::end(double now_s) {
  end_s_ = now_s;
  if (recorder_) recorder_->end(std::max(now_s - from_s_, 0.0), [this] { return look(); });
  picture_.reset();
}

void Film::save(const std::string& title, const observe::Trace& trace) const {
  if (!options_.is_asked()) return;
  require(has_begun(), "--from", "found {}, expected a time before the run's end at {:.6g} s",
          from_s_, end_s_);
  if (!options_.picture.empty()) save_picture(title);
  if (!options_.network.empty()) save_network(title, trace);
}

void Film::save_picture(const std::string& title) const {
  require(recorder_ && !recorder_->growth().empty(), "--animate",
          "found no picture of the run, expected a program that runs on a machine and shows one");
  const auto& shown = recorder_->growth();
  const double end_s = shown.back().at_s;
  const Span film{from_s_, from_s_ + end_s};
  const int height = static_cast<int>(shown[0].rgb8.size()) / 3 / width_;
  const auto place = place_picture(width_, height);
  const int last = options_.frames - 1;
  save_frames(options_.picture, options_.frames, [&](std::size_t nth) {
    const auto i = static_cast<int>(nth);
    const auto after =
        std::ranges::upper_bound(shown, end_s * i / last, {}, &snapshots::Snapshot::at_s);
    const auto& picture = i < last ? *std::prev(after) : shown.back();
    const double now_s = from_s_ + picture.at_s;
    Canvas canvas(place.width, place.height);
    draw_title(canvas, title);
    canvas.picture(place.x, place.y, {width_, height, picture.rgb8}, place.factor);
    draw_time_scale(canvas, film, {now_s, now_s});
    return Frame{canvas.bitmap(), duration_ms(i, options_.frames)};
  });
}

void Film::save_network(const std::string& title, const observe::Trace& trace) const {
  require(drawing_.has_value(), "--animate",
          "found no machine, expected a program that runs on one");
  const auto count = static_cast<std::size_t>(options_.frames);
  const auto timeline = observe::make_timeline(trace, trace.processors.size(), count);
  const Span film{trace.begin_s, trace.end_s};
  const double step_s = film.length_s() / options_.frames;
  save_frames(options_.network, options_.frames, [&](std::size_t i) {
    Busy busy;
    for (const auto& row : timeline.cpus) busy.processors.push_back(busy_share(row.columns, i));
    for (const auto& row : timeline.links) busy.links.push_back(busy_share(row.columns, i));
    const double from_s = film.from_s + step_s * static_cast<double>(i);
    const Span now{from_s, i + 1 < count ? from_s + step_s : film.to_s};
    return Frame{drawing_->draw(title, busy, film, now),
                 duration_ms(static_cast<int>(i), options_.frames)};
  });
}

}  // namespace laboratory
