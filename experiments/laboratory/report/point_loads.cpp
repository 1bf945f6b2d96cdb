#include "experiments/laboratory/report/point_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "experiments/laboratory/points/point_store.hpp"

namespace laboratory {
namespace {

using nlohmann::ordered_json;
using programs::Load;

// The share of time that a resource was busy. If no simulated time passed, the share in the JSON is
// null, and this function returns 0.
double share_of(const ordered_json& part) {
  const auto& busy = part.at("busy");
  return busy.is_null() ? 0 : busy.get<double>();
}

// The busiest resource in a list; null if the list is empty.
const ordered_json* find_busiest(const ordered_json& parts) {
  const auto busiest = std::ranges::max_element(parts, {}, share_of);
  return busiest == parts.end() ? nullptr : &*busiest;
}

// The busiest processor and the busiest link, for programs that do not describe their resources.
std::vector<Load> find_busiest_parts(const ordered_json& use) {
  std::vector<Load> loads;
  if (const auto* cpu = find_busiest(use.at("cpus")))
    loads.push_back({cpu->at("name"), share_of(*cpu), "its CPU, the busiest processor"});
  if (const auto* link = find_busiest(use.at("links")))
    loads.push_back({fmt::format("link {}>{}", link->at("from").get<std::string>(),
                                 link->at("to").get<std::string>()),
                     share_of(*link),
                     fmt::format("{} messages, {} bytes", link->at("messages").get<std::uint64_t>(),
                                 link->at("bytes").get<std::uint64_t>())});
  return loads;
}

std::vector<Load> read_loads(const ordered_json& use) {
  if (use.is_null()) return {};
  std::vector<Load> loads;
  for (const auto& load : use.at("loads"))
    loads.push_back({load.at("resource"), share_of(load), load.at("doing")});
  if (loads.empty()) loads = find_busiest_parts(use);
  std::erase_if(loads, [](const Load& load) { return load.busy <= 0; });
  std::ranges::stable_sort(loads, std::ranges::greater{}, &Load::busy);
  return loads;
}

}  // namespace

std::vector<PointLoads> load_loads(const std::filesystem::path& folder, const Simulation& s) {
  std::vector<PointLoads> points;
  for (std::size_t i = 0; i < s.file.points.size(); ++i)
    points.push_back({name_of(s.file.points[i]), s.results[i].ended,
                      read_loads(load_record(folder / s.records[i]).use)});
  return points;
}

const Load* find_limit(const PointLoads& point) {
  const bool is_limited = !point.loads.empty() && point.loads[0].busy >= SATURATED;
  return is_limited ? &point.loads[0] : nullptr;
}

std::string tell_load(const Load& load) {
  return fmt::format("{} {:.2f}{}{}", load.resource, load.busy, load.doing.empty() ? "" : ": ",
                     load.doing);
}

std::string explain(const PointLoads& point) {
  if (point.loads.empty()) return "";
  if (const auto* limit = find_limit(point))
    return fmt::format("Limited by {}.", tell_load(*limit));
  return fmt::format("Nothing is saturated; the busiest is {}.", tell_load(point.loads[0]));
}

}  // namespace laboratory
