#pragma once
// Counts, by kind, the things that a file format cannot express.

#include <fmt/format.h>

#include <map>
#include <string>

namespace renderer {

class LeftOut {
 public:
  /// `kind` is a plural, such as "spheres".
  void add(const std::string& kind) { ++counts_[kind]; }

  /// "creases (2), spheres (1)", or empty.
  std::string describe() const {
    std::string text;
    for (const auto& [kind, count] : counts_)
      text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", kind, count);
    return text;
  }

 private:
  std::map<std::string, int> counts_;
};

}  // namespace renderer
