#include "base/suggest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/text.hpp"

namespace base {

std::size_t count_edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

std::optional<std::string> find_similar(std::string_view name,
                                        const std::vector<std::string>& known) {
  constexpr std::size_t LONGEST = 200;  // a name; comparing takes the product of lengths
  constexpr std::size_t SHORTEST_PART = 3;
  if (known.empty() || name.size() > LONGEST) return {};
  auto nearest = nearest_name(name, known);
  if (3 * count_edits(name, nearest) <= std::max(name.size(), nearest.size()) + 2) return nearest;
  std::vector<std::string> parts;
  for (const auto& other : known)
    if (std::min(name.size(), other.size()) >= SHORTEST_PART &&
        (other.find(name) != other.npos || name.find(other) != name.npos))
      parts.push_back(other);
  return parts.empty() ? std::nullopt : std::optional(nearest_name(name, parts));
}

std::string suggest(std::string_view name, const std::vector<std::string>& known,
                    std::string_view phrase) {
  if (const auto similar = find_similar(name, known))
    return fmt::format(", {} \"{}\"", phrase, *similar);
  return known.empty() ? "" : fmt::format(", expected one of {}", fmt::join(known, ", "));
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  const auto similar = find_similar(name, known);
  return similar ? fmt::format(" (did you mean \"{}\"?)", *similar) : "";
}

}  // namespace base
