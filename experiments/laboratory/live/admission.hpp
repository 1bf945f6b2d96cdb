#pragma once
// Access control and rate limits for clients of the live page's server.
#include <chrono>
#include <string>
#include <string_view>

namespace laboratory {

/// Makes a secret of 32 hexadecimal digits from the host's random device.
std::string make_token();

/// Compares two texts in constant time, so that the duration does not reveal where they differ.
bool is_same_secret(std::string_view a, std::string_view b);

/// Token-bucket rate limit for a client: 200 messages per second, with bursts of 400 after silence.
/// A page requests at most 60 frames per second, and a held key sends 30 messages per second.
class Allowance {
 public:
  bool take();  ///< counts one message; false if it exceeds the limit

 private:
  static constexpr double PER_S = 200, MOST = 400;
  double left_ = MOST;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace laboratory
