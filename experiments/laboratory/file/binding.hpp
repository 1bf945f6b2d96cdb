#pragma once
// A key of a file, bound to the field it sets.
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "experiments/laboratory/file/values.hpp"

namespace laboratory {

template <class Target>
struct Binding {
  std::string key, help;
  std::function<void(Target&, const Place&)> set;
};

// Throws base::BadInput for an unknown key, with the nearest.
template <class Target>
void bind_one(Target& target, const std::vector<Binding<Target>>& bindings, const Place& at) {
  const auto found = std::ranges::find(bindings, at.key, &Binding<Target>::key);
  if (found != bindings.end()) return found->set(target, at);
  std::vector<std::string> known;
  for (const auto& b : bindings) known.push_back(b.key);
  const auto same_end = std::ranges::find_if(
      known, [&](const std::string& key) { return key.ends_with("." + at.key); });
  throw base::BadInput(
      fmt::format("{}: unknown key \"{}\", the nearest valid key is \"{}\"", at.where(), at.key,
                  same_end != known.end() ? *same_end : base::nearest_name(at.key, known)));
}

}  // namespace laboratory
