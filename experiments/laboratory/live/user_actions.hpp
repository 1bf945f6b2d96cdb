#pragma once
// Orders and faults that a user gives on the live page, in the form that experiment files have.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/live/history.hpp"
#include "simulator/observe/control_panel.hpp"

namespace laboratory {

/// An executed [[order]] or [[fault]].
struct UserAction {
  std::string table;  ///< table of the experiment file: "order" or "fault"
  /// simulated time of its execution in seconds, as in the key at_s of the file
  double at_s = 0;
  /// keys of the order or fault except at_s, with their values as TOML spells them
  std::vector<std::pair<std::string, std::string>> keys;
};

constexpr double LATEST_S = 1e9;  ///< upper limit of times in an experiment file, seconds

/// Executes the orders and faults of a run's user, and records them. Times are in simulated
/// seconds. All functions that execute throw BadInput for an invalid order or fault.
class UserActions {
 public:
  UserActions(const ExperimentFile& file, History& history);
  void begin(machine::Machine& machine, const observe::ControlPanel& view);

  /// Executes an order from a page, such as {"min_influence": 0.1, "area": [0, 0, 8, 8]}.
  void order(const nlohmann::ordered_json& order, double now_s);
  /// Executes a fault from a page: {"link": [0, 1]} or {"processor": 2}.
  void fault(const nlohmann::ordered_json& fault, double now_s);
  /// Saves the current picture. Its file name is the first of live1, live2, ... that is not used
  /// yet.
  void save(double now_s);
  /// Makes the simulated user leave, because the machine would wait for this user forever. If the
  /// program refuses the order to leave, only closes the list of orders.
  void leave(double now_s);
  bool has_left() const { return has_left_; }
  /// Called at the end of the run. If the user ended it by hand, records an order to leave at the
  /// end, so that the recording is a valid experiment.
  void end(bool by_hand);
  const std::vector<UserAction>& all() const { return all_; }

 private:
  std::pair<int, int> find_processor(const nlohmann::ordered_json& id) const;
  std::string cut_link(const nlohmann::ordered_json& link, double at_s);
  std::string stop_processor(const nlohmann::ordered_json& processor, double at_s);
  void check_with(const programs::PlannedFault& planned);

  const ExperimentFile& file_;
  History& history_;
  const programs::RecordList* orders_;  // null if the program has none
  std::vector<FaultSpec> faults_;       // faults of the file, then those of the user
  machine::Machine* machine_ = nullptr;
  observe::ControlPanel view_;
  std::vector<UserAction> all_;
  double fault_after_s_ = 0;  // time of the last fault
  bool has_left_ = false;
};

/// True if `value` is a whole number from 0 to `size` - 1.
bool is_index(const nlohmann::ordered_json& value, std::size_t size);

/// Describes the limits of a stage, which an order may also set, for the page: name, help, unit,
/// type and range.
nlohmann::ordered_json describe_limits(const programs::RecordList& stages);
/// Lists the values of `limits`, a record of a stage, in the order of describe_limits().
nlohmann::ordered_json list_limits(const programs::RecordList& stages, const std::any& limits);

}  // namespace laboratory
