#pragma once
// Who may talk to the page's server, and how much.
#include <chrono>
#include <string>
#include <string_view>

namespace laboratory {

/// 32 random hexadecimal digits, from the host's source of them.
std::string make_token();

/// Whether two texts are equal, in a time that does not tell where they differ.
bool is_same_secret(std::string_view a, std::string_view b);

/// What a client may say: 200 messages a second, and 400 at once if it was silent before. A page
/// asks for at most 60 frames a second, and a key that is held says 30 things.
class Allowance {
 public:
  bool take();  ///< one message; false if it is too many

 private:
  static constexpr double PER_S = 200, MOST = 400;
  double left_ = MOST;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace laboratory
