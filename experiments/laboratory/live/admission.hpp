#pragma once
// Access control and rate limits for clients of the page's server.
#include <chrono>
#include <string>
#include <string_view>

namespace laboratory {

/// 32 random hexadecimal digits from the host's random device.
std::string make_token();

/// Compares two texts in constant time, independent of the position of differences.
bool is_same_secret(std::string_view a, std::string_view b);

/// Rate limit of a client: 200 messages a second, with bursts of 400 after silence. A page requests
/// at most 60 frames a second, and a held key sends 30 messages a second.
class Allowance {
 public:
  bool take();  ///< one message; false if over the limit

 private:
  static constexpr double PER_S = 200, MOST = 400;
  double left_ = MOST;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace laboratory
