#include <algorithm>

#include "simulator/iirra/services.hpp"
#include "simulator/occam/case_of.hpp"
#include "simulator/occam/process.hpp"

namespace iirra {

using network::Message;
using occam::case_of;

Display::Display(Shared& shared, shared_memory::DataManager& manager)
    : shared_(shared),
      manager_(manager),
      screen_{std::vector<std::uint8_t>(3 * shared.record.samples.sums.size()),
              std::vector<TaskCell>(shared.record.samples.sums.size())},
      recorder_(shared.params.snapshot_times, shared.setup.monitor) {
  if (shared.setup.cycles_per_host_s) scratch_ = screen_;
}

void Display::run() {
  while (occam::turn(!is_stopped_)) {
    if (shared_.params.is_polled)
      poll_all();
    else
      obey(manager_.serve_at_once());
  }
  manager_.serve_for_ever();
}

// Polls every worker once, in rotation, then waits until `frame_s` has passed since the round
// began. A round that begins after Finish was received is the last one: it collects all remaining
// pictures.
void Display::poll_all() {
  const auto next_frame =
      occam::read_timer() + occam::ticks(machine::Seconds{shared_.params.frame_s});
  const auto to_keep = std::exchange(to_keep_, {});
  const bool is_last = is_finishing_;
  for (const int worker : shared_.places.workers) {
    await_answers(static_cast<std::size_t>(shared_.params.polls) - 1);
    ++asked_;
    ask(worker);
  }
  await_answers(0);
  for (const auto& name : to_keep) keep(name);
  if (is_last) return finish();
  while (!is_finishing_) {
    const auto message = manager_.serve_until(next_frame);
    if (!message) return;
    obey(*message);
  }
}

void Display::ask(int worker) {
  ++shared_.record.counts.polls;
  send(manager_, shared_.sizes, DISPLAY_PROCESS, {worker, TASK_PROCESS}, Poll{});
}

// Serves messages until at most `most` of the polled workers still have pictures to send.
void Display::await_answers(std::size_t most) {
  while (asked_ > most) obey(manager_.serve_at_once());
}

// Reports to the coordinator that all pictures are shown, and waits for Stop.
void Display::finish() {
  send(manager_, shared_.sizes, DISPLAY_PROCESS, {shared_.places.coordinator, TASK_PROCESS},
       Finished{});
  while (!is_stopped_) obey(manager_.serve_at_once());
}

void Display::obey(const Message& message) {
  const bool is_polled = shared_.params.is_polled;
  const int from = message.from.processor;
  case_of(
      read(shared_.sizes, message),
      [&](const Picture& picture) {
        show(message, picture);
        if (!is_polled)
          send(manager_, shared_.sizes, DISPLAY_PROCESS, {from, TASK_PROCESS}, PictureShown{});
        else if (picture.is_all)
          --asked_;
        else
          ask(from);
      },
      [&](const KeepPicture& picture) {
        if (is_polled)
          to_keep_.push_back(picture.name);
        else
          keep(picture.name);
      },
      [&](const Finish&) {
        is_finishing_ = true;
        // Without polling, all pictures have already been shown, because a worker sends the picture
        // of a finished pixel before it reports the pixel to the coordinator.
        if (!is_polled) finish();
      },
      [&](const Stop&) { is_stopped_ = true; },
      [&](const auto&) { throw base::InvariantBroken("a message that is not for a display"); });
}

// Draws a painted block, except on pixels that already show a newer painting. Returns true if any
// colour has changed.
bool Display::draw(const Painted& block, int width, Screen& screen, renderer::Work& work) {
  bool is_changed = false;
  auto from = block.rgb8.begin();
  const auto& area = block.area;
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x, from += 3) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x);
      if (screen.cells[pixel].paintings > block.cell.paintings) continue;
      work[renderer::Op::pixel_drawn] += 1;
      screen.cells[pixel] = block.cell;
      const auto at = screen.rgb8.begin() + static_cast<std::ptrdiff_t>(3 * pixel);
      is_changed |= !std::equal(from, from + 3, at);
      std::copy_n(from, 3, at);
    }
  return is_changed;
}

void Display::show(const Message& message, const Picture& picture) {
  auto& record = shared_.record;
  ++record.counts.pictures;
  record.counts.picture_bytes += shared_.sizes.of(picture);
  recorder_.note(shared_.now_s(), [&] { return look(); });
  for (const auto& block : picture.blocks) {
    ++record.counts.blocks;
    bool is_changed = false;
    machine::this_process().charge(static_cast<std::int64_t>(block.rgb8.size() / 3) *
                                   shared_.pixel_tested.here());
    shared_.display_cost(screen_, scratch_,
                         [kept = message.contents, &block, width = record.samples.width,
                          &is_changed, this](Screen& to, renderer::Work& work) {
                           const bool changed = draw(block, width, to, work);
                           if (&to == &screen_) is_changed = changed;
                         });
    if (!is_changed || block.order == 0) continue;
    auto& shown = record.orders_s.at(static_cast<std::size_t>(block.order) - 1).second;
    if (!shown) shown = shared_.now_s();
  }
}

void Display::keep(const std::string& name) {
  const auto now = machine::this_process().now();
  shared_.record.key_images.push_back({now, name, screen_.rgb8});
  if (shared_.params.has_borders)
    shared_.record.key_images.push_back({now, "borders-" + name, draw_borders()});
}

// Draws the upper and left borders of cells in white. Cells with sides below four pixels get no
// borders, because borders would hide these cells.
std::vector<std::uint8_t> Display::draw_borders() const {
  auto rgb8 = screen_.rgb8;
  const int width = shared_.record.samples.width;
  for (std::size_t pixel = 0; pixel < screen_.cells.size(); ++pixel) {
    const auto& cell = screen_.cells[pixel];
    const int x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
    if (cell.paintings == 0 || cell.side < 4 || (x != cell.x && y != cell.y)) continue;
    std::fill_n(rgb8.begin() + static_cast<std::ptrdiff_t>(3 * pixel), 3, 255);
  }
  return rgb8;
}

snapshots::Snapshot Display::look() const {
  return {.rays = shared_.record.rays.total(),
          .cycles = static_cast<std::uint64_t>(shared_.kernel_cycles().value),
          .rgb8 = screen_.rgb8};
}

void Display::end(double at_s) {
  recorder_.end(at_s, [&] { return look(); });
  shared_.record.rgb8 = screen_.rgb8;
  if (shared_.params.has_borders)
    shared_.record.key_images.push_back(
        {machine::Seconds{shared_.record.ended_s}, "borders", draw_borders()});
  shared_.record.pictures = recorder_.pictures();
  shared_.record.growth = recorder_.growth();
}

}  // namespace iirra
