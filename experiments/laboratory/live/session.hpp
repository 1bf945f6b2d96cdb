#pragma once
// Live session: a run that pages watch and steer. It makes their frames, paces the clock and
// executes the user's actions.
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "experiments/laboratory/live/machine_state.hpp"
#include "experiments/laboratory/live/spans.hpp"
#include "experiments/laboratory/live/user_actions.hpp"

namespace laboratory {

/// Snapshot of the run between two events, for pages.
struct Frame {
  std::uint64_t number = 0;      ///< number of the frame, from 1
  nlohmann::ordered_json state;  ///< state as listed in docs/manual/live.md
  /// The current picture: rows from the top, 3 bytes per pixel. Frames share the object while the
  /// picture is unchanged.
  std::shared_ptr<const std::vector<std::uint8_t>> rgb8;
  /// The picture of the sequential renderer, once a page has requested it and it is complete.
  std::shared_ptr<const std::vector<std::uint8_t>> sequential;
};

/// Queue of the pages' requests, and their execution by the simulation. Any thread may call the
/// functions for pages. Pages never wait for the simulation, nor the simulation for pages.
class Session : public observe::RunController {
 public:
  /// Receives "" on success, else the reason of the refusal. The simulation's thread calls it.
  using Reply = std::function<void(const std::string& refusal)>;
  using Command = nlohmann::ordered_json;

  /// Makes a session for a file with one point. `speed` is simulated seconds per second; infinite:
  /// no pacing.
  Session(const ExperimentFile& file, double speed);

  // --- for pages ----------------------------------------------------------------------------
  /// The constant part of the run: title, program, limits, and processors and links with their
  /// positions. Null before the machine exists.
  std::shared_ptr<const nlohmann::ordered_json> outline() const;
  /// Queues a command in the format of docs/manual/live.md.
  void ask(Command command, Reply reply);
  /// Requests a frame. It is made at the next event, or at once if the run is paused.
  void want_frame();
  /// The newest frame; null before the first.
  std::shared_ptr<const Frame> frame() const;
  /// Sets the function that the simulation's thread calls for every new frame.
  void on_frame(std::function<void()> told);

  // --- for the simulation -------------------------------------------------------------------
  void begin(machine::Machine& machine, const observe::ControlPanel& view) override;
  bool before(double date) override;
  void end(const std::string& fault) override;

  /// Tells the pages where the results of the ended run are. The server continues.
  void say_results(const std::string& text);
  /// Waits until a page asks to quit, or the user interrupts.
  void wait_for_quit();

  const std::vector<UserAction>& actions() const { return actions_; }
  /// The simulated time at which the user ended the run; none if it ended by itself.
  std::optional<double> ended_by_hand_s() const { return ended_by_hand_s_; }

 private:
  using HostClock = std::chrono::steady_clock;
  static constexpr double NEVER = std::numeric_limits<double>::infinity();
  static constexpr double LATEST_S = 1e9;  ///< upper limit of times in an experiment file
  enum class Phase { running, paused, waiting, over };
  struct Asked {
    Command command;
    Reply reply;
  };
  /// Condition at which the run pauses again: after a step, at a time, or at an event.
  struct Goal {
    /// simulated time at which the run pauses at the latest
    double date = std::numeric_limits<double>::infinity();
    bool is_next_date = false, is_message = false, is_ray = false, is_picture = false;
    std::uint64_t messages = 0;  ///< number of messages when the goal was set
    double rays = 0;
    std::shared_ptr<const std::vector<std::uint8_t>> picture;
    /// True if the run may never reach the goal while the machine waits for the user.
    bool is_endless() const { return std::isinf(date) && !is_next_date && !is_message; }
  };

  bool attend(double date);
  bool follow_goal(double date);
  void show();
  HostClock::duration hold_back(double date);
  void change_phase(Phase phase);
  bool waits_for_user(bool is_idle) const;
  void obey_all();
  void obey(const Command& command);
  void obey_order(const Command& order);
  void obey_fault(const Command& fault);
  void pause();
  void go();
  void save();
  void quit();
  void select(const Command& command);
  void end_by_hand();
  void set_goal(const Goal& goal);
  void step(const std::string& what);
  void run_to(const Command& goal);
  void render_sequentially();
  bool is_reached(double date);
  void leave();
  void set_pace(double speed);
  double paced_s() const;
  double shown_s() const;
  void make_frame();
  std::shared_ptr<const std::vector<std::uint8_t>> look();
  void observe(bool is_told);
  std::uint64_t count_messages() const;

  const ExperimentFile& file_;
  const programs::RecordList* orders_;
  std::vector<FaultSpec> faults_;  // faults of the file, then those of the user

  // The members below are used by the simulation's thread only.
  machine::Machine* machine_ = nullptr;
  observe::ControlPanel view_;
  Spans spans_;
  std::vector<UserAction> actions_;
  std::optional<double> ended_by_hand_s_;
  Phase phase_ = Phase::running;
  std::optional<Goal> goal_;
  double speed_;
  HostClock::time_point pace_since_;
  double pace_from_s_ = 0;    // simulated time at the host time pace_since_
  double next_s_ = 0;         // simulated time of the next event
  double go_until_s_ = 0;     // the simulated time before which pacing needs no check
  double fault_after_s_ = 0;  // simulated time of the last fault
  HostClock::time_point next_frame_at_;
  RecentLoads loads_;
  std::map<std::uint64_t, std::vector<int>> selected_;  // selected processors, by page
  bool has_left_ = false, is_observing_ = true;
  std::string fault_;
  bool has_thrown_ = false;  // the fault was an exception in a process
  std::uint64_t calls_ = 0, frames_ = 0;

  // The members below are used by all threads. The mutex guards those that are not atomic.
  mutable std::mutex mutex_;
  std::condition_variable asked_anything_;
  std::deque<Asked> asked_;
  std::shared_ptr<const Frame> frame_;
  std::shared_ptr<const nlohmann::ordered_json> outline_;
  std::shared_ptr<const std::vector<std::uint8_t>> sequential_;
  std::function<void()> told_;
  bool wants_frame_ = false, is_quitting_ = false;
  bool is_new_ = true;                // something has changed since the last frame
  std::atomic<bool> has_news_{true};  // a command or a request for a frame is pending
  std::jthread renders_;              // thread that renders the sequential picture
};

}  // namespace laboratory
