#pragma once
// A live run, which browser pages show and control. The session makes snapshots (frames) for the
// pages, keeps the set speed, and executes the user's commands.
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

#include "experiments/laboratory/live/history.hpp"
#include "experiments/laboratory/live/machine_state.hpp"
#include "experiments/laboratory/live/spans.hpp"
#include "experiments/laboratory/live/user_actions.hpp"

namespace laboratory {

/// Snapshot of the run between two events, to be shown by pages.
struct Frame {
  std::uint64_t number = 0;      ///< number of the frame, from 1
  nlohmann::ordered_json state;  ///< state of the run, as listed in docs/manual/live.md
  /// The current picture: rows from the top, 3 bytes per pixel. Frames share the object as long as
  /// the picture does not change.
  std::shared_ptr<const std::vector<std::uint8_t>> rgb8;
  /// the picture of the sequential renderer, once a page has asked for it and it is complete
  std::shared_ptr<const std::vector<std::uint8_t>> sequential;
};

/// Queue of the pages' commands, which the simulation executes between two events. Functions for
/// pages may be called in any thread. Pages never wait for the simulation, and the simulation never
/// waits for pages.
class Session : public observe::RunController {
 public:
  /// Receives "" on success, else the reason why a command was refused. Called in the simulation's
  /// thread.
  using Reply = std::function<void(const std::string& refusal)>;
  using Command = nlohmann::ordered_json;

  /// Makes a session for an experiment file with one point. `speed` is in simulated seconds per
  /// second of host time; infinite: as fast as possible.
  Session(const ExperimentFile& file, double speed);

  // --- for pages ----------------------------------------------------------------------------
  /// Description of what stays the same during a run: title, program, limits, and processors and
  /// links with their positions. Null before the machine exists.
  std::shared_ptr<const nlohmann::ordered_json> outline() const;
  /// Queues a command, in the format of docs/manual/live.md.
  void ask(Command command, Reply reply);
  /// Asks for a frame. It is made before the next event, or at once if the run is paused.
  void want_frame();
  /// The newest frame; null if there is none yet.
  std::shared_ptr<const Frame> frame() const;
  /// The growth curves and the user's actions since the start of the run.
  const History& history() const { return history_; }
  /// Sets the function that the simulation's thread calls for every new frame.
  void on_frame(std::function<void()> told);

  // --- for the simulation -------------------------------------------------------------------
  void begin(machine::Machine& machine, const observe::ControlPanel& view) override;
  bool before(double date) override;
  void end(const std::string& fault) override;

  /// Tells the pages where the results of the ended run are. Pages can still connect afterwards.
  void say_results(const std::string& text);
  /// Waits until a page asks to quit, or the user interrupts.
  void wait_for_quit();

  const std::vector<UserAction>& actions() const { return actions_; }
  /// The simulated time, in seconds, at which the user ended the run; no value if it ended by
  /// itself.
  std::optional<double> ended_by_hand_s() const { return ended_by_hand_s_; }

 private:
  using HostClock = std::chrono::steady_clock;
  static constexpr double NEVER = std::numeric_limits<double>::infinity();
  static constexpr double LATEST_S = 1e9;  ///< upper limit of times in an experiment file, seconds
  enum class Phase { running, paused, waiting, over };
  struct Asked {
    Command command;
    Reply reply;
  };
  /// Condition at which the run pauses again. It stands for a single step, or for "run to".
  struct Goal {
    /// simulated time, in seconds, at which the run pauses at the latest
    double date = std::numeric_limits<double>::infinity();
    bool is_next_date = false, is_message = false, is_ray = false, is_picture = false;
    std::uint64_t messages = 0;  ///< number of messages that had been sent when the goal was set
    double rays = 0;
    std::shared_ptr<const std::vector<std::uint8_t>> picture;
    /// True if the goal is the next ray or the next change of the picture, which may never come
    /// while the machine waits for the user.
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
  void take_sample();
  double picture_error() const;
  void make_frame();
  std::shared_ptr<const std::vector<std::uint8_t>> look();
  void observe(bool is_told);
  std::uint64_t count_messages() const;

  const ExperimentFile& file_;
  const programs::RecordList *orders_, *stages_;  // null if the program has none
  std::vector<FaultSpec> faults_;                 // faults of the file, then those of the user

  // only the simulation's thread uses the following members
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
  HostClock::time_point next_frame_at_, next_sample_at_;
  double spans_from_s_ = 0;  // simulated time of the last frame
  RecentLoads loads_;
  // processors selected for description, by number of the page
  std::map<std::uint64_t, std::vector<int>> selected_;
  bool has_left_ = false, is_observing_ = true;
  std::string fault_;
  bool has_thrown_ = false;  // true: the fault that ended the run was an exception in a process
  std::uint64_t calls_ = 0, frames_ = 0;

  History history_;
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
  std::atomic<bool> has_news_{true};  // true: a command or a request for a frame waits
  std::jthread renders_;              // thread that renders the picture sequentially
};

}  // namespace laboratory
