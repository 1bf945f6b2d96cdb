#pragma once
// What processors did lately, for a time line that grows.
#include <nlohmann/json.hpp>
#include <vector>

#include "simulator/machine/machine.hpp"

namespace laboratory {

/// Keeps what the first processors did since the last time it was asked, as long as somebody asks:
/// no more than a page can draw. What is shorter than the time line can show is added to what
/// comes before it.
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

  /// [processor, doing (0 high, 1 low, 2 switching), from, to] one after the other, times in s.
  /// What is taken is forgotten.
  nlohmann::ordered_json take();
  /// The same of what goes on at present, which is told again when it has ended.
  static nlohmann::ordered_json look_at(const machine::Machine& machine);
  bool is_cut() const { return is_cut_; }  ///< there was more since the last take()

 private:
  struct Span {
    int processor;
    Doing doing;
    double from_s, to_s;
  };
  std::vector<Span> spans_;
  std::vector<std::size_t> last_;  // of each processor, in spans_, and one more; 0: none
  bool is_cut_ = false;
};

}  // namespace laboratory
