#include "experiments/laboratory/live/admission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

namespace laboratory {

std::string make_token() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device());
  return token;
}

bool is_same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference = static_cast<unsigned char>(difference | (a[i] ^ b[i]));
  return difference == 0;
}

bool Allowance::take() {
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> since = now - last_;
  last_ = now;
  left_ = std::min(MOST, left_ + since.count() * PER_S);
  if (left_ < 1) return false;
  left_ -= 1;
  return true;
}

}  // namespace laboratory
