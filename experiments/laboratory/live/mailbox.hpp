#pragma once
// Exchange between a live run and its pages: commands to the run, and frames to the pages.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>

#include "experiments/laboratory/live/history.hpp"

namespace laboratory {

using Rgb8 = std::shared_ptr<const std::vector<std::uint8_t>>;

/// Snapshot of the run between two events, to be shown by pages.
struct Frame {
  std::uint64_t number = 0;      ///< number of the frame, from 1
  nlohmann::ordered_json state;  ///< state of the run, as listed in docs/manual/live.md
  /// The current picture: rows from the top, 3 bytes per pixel. Frames share the object as long as
  /// the picture does not change.
  Rgb8 rgb8;
  /// the picture of the sequential renderer, once a page has asked for it and it is complete
  Rgb8 sequential;
};

/// Functions for pages may be called in any thread. Pages never wait for the simulation, and the
/// simulation never waits for pages.
class Mailbox {
 public:
  /// Receives "" on success, else the reason why a command was refused. Called in the simulation's
  /// thread.
  using Reply = std::function<void(const std::string& refusal)>;
  using Command = nlohmann::ordered_json;

  // --- for pages ----------------------------------------------------------------------------
  /// Description of what stays the same during a run: title, program, limits, and processors and
  /// links with their positions. Null before the machine exists.
  std::shared_ptr<const nlohmann::ordered_json> outline() const { return copy(outline_); }
  /// Queues a command, in the format of docs/manual/live.md.
  void ask(Command command, Reply reply);
  /// Asks for a frame. It is made before the next event, or at once if the run is paused.
  void want_frame();
  /// The newest frame; null if there is none yet.
  std::shared_ptr<const Frame> frame() const { return copy(frame_); }
  /// The growth curves and the user's actions since the start of the run.
  const History& history() const { return history_; }
  /// Sets the function that the simulation's thread calls for every new frame.
  void on_frame(std::function<void()> told) { replace(told_, std::move(told)); }

 protected:
  // --- for the simulation -------------------------------------------------------------------
  using HostClock = std::chrono::steady_clock;
  struct Asked {
    Command command;
    Reply reply;
  };

  /// True if a command or a request for a frame waits.
  bool has_news() const { return has_news_.load(std::memory_order_relaxed); }
  std::deque<Asked> take_commands();
  /// Waits until there is news, but at most this long.
  void wait_for_news(HostClock::duration longest);
  /// Notes that something has changed since the last frame.
  void note_change() { replace(is_new_, true); }
  /// True if a page has asked for a frame and something has changed. The request is then removed.
  bool take_request();
  void publish_outline(nlohmann::ordered_json outline) {
    replace(outline_, std::make_shared<const nlohmann::ordered_json>(std::move(outline)));
  }
  /// Numbers the frame, adds the sequential picture and shows the frame to the pages.
  void publish(std::shared_ptr<Frame> made);
  /// The picture of the sequential renderer; null if there is none.
  Rgb8 sequential() const { return copy(sequential_); }
  void set_sequential(Rgb8 picture) {
    replace(sequential_, std::move(picture));
    note_change();
  }

  History history_;

 private:
  template <class T>
  T copy(const T& member) const {
    const std::lock_guard lock(mutex_);
    return member;
  }
  template <class T>
  void replace(T& member, T value) {
    const std::lock_guard lock(mutex_);
    member = std::move(value);
  }

  mutable std::mutex mutex_;  // guards all following members that are not atomic
  std::condition_variable asked_anything_;
  std::deque<Asked> asked_;
  std::uint64_t frames_ = 0;
  std::shared_ptr<const Frame> frame_;
  std::shared_ptr<const nlohmann::ordered_json> outline_;
  Rgb8 sequential_;
  std::function<void()> told_;
  bool wants_frame_ = false;
  bool is_new_ = true;  // something has changed since the last frame
  std::atomic<bool> has_news_{true};
};

}  // namespace laboratory
