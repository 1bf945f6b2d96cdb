#pragma once
// Access control and rate limits for the browser pages that connect to a live run.
#include <chrono>
#include <string>
#include <string_view>

namespace laboratory {

/// Makes a secret of 32 hexadecimal digits from the host's random device.
std::string make_token();

/// Compares two texts in constant time, so that the time taken does not reveal where they differ.
bool is_same_secret(std::string_view a, std::string_view b);

/// Limits the message rate of a client to 200 per second (a token bucket), with bursts of 400 after
/// silence. A page normally needs less: it requests at most 60 frames per second, and a key held
/// down sends 30 messages per second.
class Allowance {
 public:
  bool take();  ///< counts one message; false if it exceeds the limit

 private:
  static constexpr double PER_S = 200, MOST = 400;
  double left_ = MOST;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace laboratory
