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
      rgb8_(3 * shared.record.samples.sums.size()),
      recorder_(shared.params.looks) {
  if (shared.params.cycles_per_host_s) scratch_ = rgb8_;
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

// Each worker is asked in its turn, as soon as the display is at leisure; but none more often than
// the screen shows a new frame.
void Display::poll_all() {
  const auto next_frame =
      occam::read_timer() + occam::ticks(machine::Seconds{shared_.params.frame_s});
  is_all_ = true;
  kept_next_ = std::exchange(to_keep_, {});
  was_finishing_ = is_finishing_;
  for (const int worker : shared_.places.workers) {
    ++shared_.record.counts.polls;
    send(manager_, shared_.sizes, {worker, TASK_PROCESS}, Poll{});
    for (is_answered_ = false; !is_answered_ && !is_stopped_;) obey(manager_.serve_at_once());
    if (is_stopped_) return;
  }
  end_round(is_all_);
  while (!is_stopped_ && !is_finishing_) {
    const auto message = manager_.serve_until(next_frame);
    if (!message) return;
    obey(*message);
  }
}

void Display::end_round(bool is_all) {
  for (const auto& name : std::exchange(kept_next_, {}))
    shared_.record.key_images.push_back({machine::this_process().now(), name, rgb8_});
  if (!was_finishing_ || !is_all) return;
  send(manager_, shared_.sizes, {shared_.places.coordinator, TASK_PROCESS}, Finished{});
  while (!is_stopped_) obey(manager_.serve_at_once());
}

void Display::obey(const Message& message) {
  case_of(
      read(shared_.sizes, message),
      [&](const Picture& picture) {
        is_answered_ = true;
        is_all_ &= picture.is_all;
        show(message, picture);
        if (!shared_.params.is_polled)
          send(manager_, shared_.sizes, {message.from.processor, TASK_PROCESS}, Shown{});
      },
      [&](const KeepPicture& keep) {
        if (shared_.params.is_polled) return to_keep_.push_back(keep.name);
        kept_next_ = {keep.name};
        end_round(false);
      },
      [&](const Finish&) {
        is_finishing_ = was_finishing_ = true;
        // Every worker waits until its pictures are shown before it says that it has finished.
        if (!shared_.params.is_polled) end_round(true);
        was_finishing_ = false;
      },
      [&](const Stop&) { is_stopped_ = true; },
      [&](const auto&) { throw base::InvariantBroken("a message that is not for a display"); });
}

void Display::show(const Message& message, const Picture& picture) {
  auto& record = shared_.record;
  ++record.counts.pictures;
  record.counts.picture_bytes += shared_.sizes.of(picture);
  recorder_.note(shared_.now_s(), [&] { return look(); });
  for (const auto& block : picture.blocks) {
    ++record.counts.blocks;
    bool is_changed = false;
    shared_.display_cost(
        rgb8_, scratch_,
        [kept = message.contents, &block, width = record.samples.width, &changed = is_changed, this](auto& to, renderer::Work& work) {
          const auto row = 3 * static_cast<std::size_t>(block.area.width);
          for (int y = 0; y < block.area.height; ++y) {
            const auto from = block.rgb8.begin() + static_cast<std::ptrdiff_t>(row) * y;
            const auto at = to.begin() + 3 * (static_cast<std::ptrdiff_t>(block.area.y + y) * width +
                                              block.area.x);
            if (&to == &rgb8_ && !std::equal(from, from + static_cast<std::ptrdiff_t>(row), at))
              changed = true;
            std::copy_n(from, row, at);
            work[renderer::Op::pixel_drawn] += static_cast<std::uint64_t>(block.area.width);
          }
        });
    if (!is_changed || block.order == 0) continue;
    auto& shown = record.orders_s.at(static_cast<std::size_t>(block.order) - 1).second;
    if (!shown) shown = shared_.now_s();
  }
}

growth::Shown Display::look() const {
  return {.rays = shared_.record.rays.total(),
          .cycles = static_cast<std::uint64_t>(shared_.kernel_cycles().value),
          .rgb8 = rgb8_};
}

void Display::end(double at_s) {
  recorder_.end(at_s, [&] { return look(); });
  shared_.record.rgb8 = rgb8_;
  shared_.record.pictures = recorder_.pictures();
  shared_.record.growth = recorder_.growth();
}

}  // namespace iirra
