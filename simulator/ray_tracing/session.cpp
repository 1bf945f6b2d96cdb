#include "simulator/ray_tracing/session.hpp"

namespace ray_tracing {

bool is_picture_name(const std::string& name) {
  return !name.empty() && name.size() <= 40 &&
         std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '-'; });
}

void check_saved_names(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const auto& name : names) {
    for (const char* taken : {"stage", "order", "shown", "growth", "borders"})
      if (name.starts_with(taken))
        base::refuse("order.save", "found \"{}\", expected a name that does not begin with {}",
                     name, taken);
    if (std::ranges::find(known, name) != known.end())
      base::refuse("order.save", "found \"{}\" twice, expected different names", name);
    known.push_back(name);
  }
}

}  // namespace ray_tracing
