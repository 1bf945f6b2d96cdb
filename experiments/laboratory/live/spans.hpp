#pragma once
// Recent activity of processors, for a growing time line.
#include <nlohmann/json.hpp>
#include <vector>

#include "simulator/machine/machine.hpp"

namespace laboratory {

/// Records the activity of the first processors since the last take(), as much as a page can draw.
/// Joins spans of equal activity with gaps too short for the time line.
class Spans : public machine::Observer {
 public:
  static constexpr int MOST_PROCESSORS = 64;
  static constexpr std::size_t MOST = 4096;  ///< spans kept; beyond that, `is_cut`

  void name_process(const machine::Processor& on, std::uint32_t id,
                    const std::string& name) override;
  void ran(const machine::Processor& on, std::uint32_t id, Doing doing, machine::Seconds from,
           machine::Seconds to) override;
  void moved(const machine::LinkDirection& link, const std::string& channel, std::uint64_t bytes,
             machine::Seconds from, machine::Seconds to) override;

  /// [processor, doing (0 high, 1 low, 2 switching), from, to] in sequence, times in s. Clears the
  /// recorded spans.
  nlohmann::ordered_json take();
  /// The same of current activity, which is reported again when it has ended.
  static nlohmann::ordered_json look_at(const machine::Machine& machine);
  bool is_cut() const { return is_cut_; }  ///< the limit was reached since the last take()

 private:
  struct Span {
    int processor;
    Doing doing;
    double from_s, to_s;
  };
  std::vector<Span> spans_;
  std::vector<std::size_t> last_;  // by processor: index in spans_ plus 1; 0: none
  bool is_cut_ = false;
};

}  // namespace laboratory
