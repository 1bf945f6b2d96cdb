#pragma once
// Recent activity of processors, for a chart on the live page that grows with time.
#include <nlohmann/json.hpp>
#include <vector>

#include "simulator/machine/machine.hpp"

namespace laboratory {

/// Observer of the activity of the first processors since the last take(). Keeps at most as many
/// time spans as a page can draw. Joins spans of the same activity if the gap between them would be
/// invisible.
class Spans : public machine::Observer {
 public:
  static constexpr int MOST_PROCESSORS = 64;
  /// limit on kept time spans; is_cut() returns true after it was reached
  static constexpr std::size_t MOST = 4096;

  void name_process(const machine::Processor& on, std::uint32_t id,
                    const std::string& name) override;
  void ran(const machine::Processor& on, std::uint32_t id, Doing doing, machine::Seconds from,
           machine::Seconds to) override;
  void moved(const machine::LinkDirection& link, const std::string& channel, std::uint64_t bytes,
             machine::Seconds from, machine::Seconds to) override;

  /// Returns the recorded time spans and clears them. The result is a flat list with four numbers
  /// for each span: processor, activity (0: high priority, 1: low priority, 2: process switch),
  /// begin and end in seconds.
  nlohmann::ordered_json take();
  /// Lists the activities that have not ended yet, in the format of take(). When such an activity
  /// has ended, take() reports it again as a whole.
  static nlohmann::ordered_json look_at(const machine::Machine& machine);
  bool is_cut() const { return is_cut_; }  ///< true if the limit was reached since the last take()

 private:
  struct Span {
    int processor;
    Doing doing;
    double from_s, to_s;
  };
  std::vector<Span> spans_;
  // index in spans_ of each processor's last span, plus 1; 0: the processor has none
  std::vector<std::size_t> last_;
  bool is_cut_ = false;
};

}  // namespace laboratory
