#pragma once
// A live run, which browser pages show and control. The session makes snapshots (frames) for the
// pages, keeps the set speed, and executes the user's commands.
#include <map>
#include <thread>

#include "experiments/laboratory/live/machine_state.hpp"
#include "experiments/laboratory/live/mailbox.hpp"
#include "experiments/laboratory/live/pacer.hpp"
#include "experiments/laboratory/live/spans.hpp"
#include "experiments/laboratory/live/user_actions.hpp"

namespace laboratory {

/// Executes the pages' commands between two events. Only the simulation's thread may call the
/// functions, except those of Mailbox for pages.
class Session : public observe::RunController, public Mailbox {
 public:
  /// Makes a session for an experiment file with one point. `speed` is in simulated seconds per
  /// second of host time; infinite: as fast as possible.
  Session(const ExperimentFile& file, double speed);

  void begin(machine::Machine& machine, const observe::ControlPanel& view) override;
  bool before(double date) override;
  void end(const std::string& fault) override;

  /// Tells the pages where the results of the ended run are. Pages can still connect afterwards.
  void say_results(const std::string& text);
  /// Waits until a page asks to quit, or the user interrupts.
  void wait_for_quit();

  const std::vector<UserAction>& actions() const { return actions_.all(); }
  /// The simulated time, in seconds, at which the user ended the run; no value if it ended by
  /// itself.
  std::optional<double> ended_by_hand_s() const { return ended_by_hand_s_; }

 private:
  static constexpr double NEVER = std::numeric_limits<double>::infinity();
  enum class Phase { running, paused, waiting, over };
  /// Condition at which the run pauses again. It stands for a single step, or for "run to".
  struct Goal {
    /// simulated time, in seconds, at which the run pauses at the latest
    double date = std::numeric_limits<double>::infinity();
    bool is_next_date = false, is_message = false, is_ray = false, is_picture = false;
    std::uint64_t messages = 0;  ///< number of messages that had been sent when the goal was set
    double rays = 0;
    Rgb8 picture;
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
  void pause();
  void go();
  void quit();
  void select(const Command& command);
  void end_by_hand();
  void set_goal(const Goal& goal);
  void step(const std::string& what);
  void run_to(const Command& goal);
  void render_sequentially();
  bool is_reached(double date);
  void set_pace(double speed);
  double shown_s() const;
  void take_sample();
  double picture_error() const;
  void make_frame();
  Rgb8 look();
  void observe(bool is_told);
  std::uint64_t count_messages() const;

  const ExperimentFile& file_;
  const programs::RecordList* stages_;  // null if the program has none
  machine::Machine* machine_ = nullptr;
  observe::ControlPanel view_;
  Spans spans_;
  UserActions actions_;
  std::optional<double> ended_by_hand_s_;
  Phase phase_ = Phase::running;
  std::optional<Goal> goal_;
  Pacer pacer_;
  double next_s_ = 0;  // simulated time of the next event
  HostClock::time_point next_frame_at_, next_sample_at_;
  double spans_from_s_ = 0;  // simulated time of the last frame
  RecentLoads loads_;
  // processors selected for description, by number of the page
  std::map<std::uint64_t, std::vector<int>> selected_;
  bool is_observing_ = true, is_quitting_ = false;
  std::string fault_;
  bool has_thrown_ = false;  // true: the fault that ended the run was an exception in a process
  std::uint64_t calls_ = 0;
  std::jthread renders_;  // thread that renders the picture sequentially
};

}  // namespace laboratory
