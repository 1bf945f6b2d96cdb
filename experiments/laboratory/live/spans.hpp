#pragma once
// Recent activity of processors, for a growing Gantt chart.
#include <nlohmann/json.hpp>
#include <vector>

#include "simulator/machine/machine.hpp"

namespace laboratory {

/// Observer of the first processors' activity since the last take(), limited to what a page can
/// draw. Joins spans of equal activity if the gap is too short to be visible.
class Spans : public machine::Observer {
 public:
  static constexpr int MOST_PROCESSORS = 64;
  /// limit on kept spans; `is_cut` tells when it is reached
  static constexpr std::size_t MOST = 4096;

  void name_process(const machine::Processor& on, std::uint32_t id,
                    const std::string& name) override;
  void ran(const machine::Processor& on, std::uint32_t id, Doing doing, machine::Seconds from,
           machine::Seconds to) override;
  void moved(const machine::LinkDirection& link, const std::string& channel, std::uint64_t bytes,
             machine::Seconds from, machine::Seconds to) override;

  /// Returns the recorded spans and clears them. They are a flat list of processor, activity (0
  /// high priority, 1 low, 2 switching), begin and end in s.
  nlohmann::ordered_json take();
  /// Lists the activities that have not ended, in the same format. take() reports them again once
  /// they have ended.
  static nlohmann::ordered_json look_at(const machine::Machine& machine);
  bool is_cut() const { return is_cut_; }  ///< true if the limit was reached since the last take()

 private:
  struct Span {
    int processor;
    Doing doing;
    double from_s, to_s;
  };
  std::vector<Span> spans_;
  // last span of each processor: its index in spans_ plus 1; 0: none
  std::vector<std::size_t> last_;
  bool is_cut_ = false;
};

}  // namespace laboratory
