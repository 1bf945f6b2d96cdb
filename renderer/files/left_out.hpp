#pragma once
// Counter of scene parts that a file format cannot express, by kind.

#include <fmt/format.h>

#include <map>
#include <string>

namespace renderer {

class LeftOut {
 public:
  /// `kind` is a plural, such as "spheres".
  void add(const std::string& kind) { ++counts_[kind]; }

  /// Formats the counts: "creases (2), spheres (1)"; "" if nothing was left out.
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
