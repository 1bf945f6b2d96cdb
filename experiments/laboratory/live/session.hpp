#pragma once
// A run that pages watch and steer: frames for the pages, pacing of the clock, and the user's
// actions.
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

/// The state of the run between two events.
struct Frame {
  std::uint64_t number = 0;      ///< from 1
  nlohmann::ordered_json state;  ///< as docs/manual/live.md lists it
  /// The picture, rows from the top, 3 bytes a pixel; an unchanged picture keeps its object.
  std::shared_ptr<const std::vector<std::uint8_t>> rgb8;
  /// The same of the sequential renderer, once requested and complete.
  std::shared_ptr<const std::vector<std::uint8_t>> sequential;
};

/// Requests of pages, and their execution. The functions for pages may be called by any thread;
/// they and the simulation never wait for each other.
class Session : public observe::RunController {
 public:
  /// Called by the simulation's thread: "" on success, else the reason of the refusal.
  using Reply = std::function<void(const std::string& refusal)>;
  using Command = nlohmann::ordered_json;

  /// `speed`: simulated seconds a second; infinite: no pacing. The file has one point.
  Session(const ExperimentFile& file, double speed);

  // --- for pages ----------------------------------------------------------------------------
  /// The constant part: title, program, processors and links with their places, limits. Null before
  /// the machine exists.
  std::shared_ptr<const nlohmann::ordered_json> outline() const;
  /// Queues a command in the format of docs/manual/live.md.
  void ask(Command command, Reply reply);
  /// Requests a new frame, made at the next event or in an idle moment.
  void want_frame();
  /// The newest frame; null before the first.
  std::shared_ptr<const Frame> frame() const;
  /// Called by the simulation's thread for every new frame.
  void on_frame(std::function<void()> told);

  // --- for the simulation -------------------------------------------------------------------
  void begin(machine::Machine& machine, const observe::ControlPanel& view) override;
  bool before(double date) override;
  void end(const std::string& fault) override;

  /// After the run: `text` names the place of its results. Pages are still served.
  void say_results(const std::string& text);
  /// Waits until a page asks to quit, or the user interrupts.
  void wait_for_quit();

  const std::vector<UserAction>& actions() const { return actions_; }
  /// The simulated time at which the user ended the run; none if it ended by itself.
  std::optional<double> ended_by_hand_s() const { return ended_by_hand_s_; }

 private:
  using HostClock = std::chrono::steady_clock;
  static constexpr double NEVER = std::numeric_limits<double>::infinity();
  static constexpr double LATEST_S = 1e9;  ///< the latest time in an experiment file
  enum class Phase { running, paused, waiting, over };
  struct Asked {
    Command command;
    Reply reply;
  };
  /// The end of a step, or of a run up to a condition.
  struct Goal {
    double date = std::numeric_limits<double>::infinity();  ///< at the latest
    bool is_next_date = false, is_message = false, is_ray = false, is_picture = false;
    std::uint64_t messages = 0;  ///< at its beginning
    double rays = 0;
    std::shared_ptr<const std::vector<std::uint8_t>> picture;
    /// True if the goal may never be reached while the machine waits for the user.
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
  const observe::ControlPanel::Gauge* find_rays() const;  // null if none are traced

  const ExperimentFile& file_;
  const programs::RecordList* orders_;
  std::vector<FaultSpec> faults_;  // of the file and the user

  // Used by the simulation's thread only.
  machine::Machine* machine_ = nullptr;
  observe::ControlPanel view_;
  Spans spans_;
  std::vector<UserAction> actions_;
  std::optional<double> ended_by_hand_s_;
  Phase phase_ = Phase::running;
  std::optional<Goal> goal_;
  double speed_;
  HostClock::time_point pace_since_;
  double pace_from_s_ = 0;    // simulated, at pace_since_
  double next_s_ = 0;         // the date of the next event
  double go_until_s_ = 0;     // no check of the host's clock is due before this date
  double fault_after_s_ = 0;  // of the last fault
  HostClock::time_point next_frame_at_;
  RecentLoads loads_;
  std::map<std::uint64_t, std::vector<int>> selected_;  // processors, by page
  bool has_left_ = false, is_observing_ = true;
  std::string fault_;
  bool has_thrown_ = false;  // a process threw, which was the fault
  std::uint64_t calls_ = 0, frames_ = 0;

  // Used by all threads; the mutex guards everything not atomic.
  mutable std::mutex mutex_;
  std::condition_variable asked_anything_;
  std::deque<Asked> asked_;
  std::shared_ptr<const Frame> frame_;
  std::shared_ptr<const nlohmann::ordered_json> outline_;
  std::shared_ptr<const std::vector<std::uint8_t>> sequential_;
  std::function<void()> told_;
  bool wants_frame_ = false, is_quitting_ = false;
  bool is_new_ = true;  // the last frame is outdated; else a page that wants one waits
  std::atomic<bool> has_news_{true};  // a command or a request for a frame is pending
  std::jthread renders_;              // the sequential picture
};

}  // namespace laboratory
