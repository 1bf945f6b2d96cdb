#include "experiments/laboratory/uncertain/draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/errors.hpp"
#include "base/random.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/setup/setup.hpp"

namespace laboratory {

namespace {

constexpr std::size_t MOST_POINTS = 1'000'000;

bool is_set(const machine::Overrides& set, const std::string& key) {
  return std::ranges::find(set, key, &machine::Overrides::value_type::first) != set.end();
}

// The random seed for an entry: a hash of its name, and hence the same on every host.
std::uint64_t number_of(const std::string& entry) {
  return std::stoull(hash_of(entry).substr(0, 16), nullptr, 16);
}

// For each machine, its slice of the entry's range in a Latin hypercube: a permutation that the
// seed and the entry determine.
std::vector<std::size_t> shuffle_slices(std::uint64_t stream, std::size_t machines) {
  std::vector<std::pair<std::uint64_t, std::size_t>> keyed;
  for (std::size_t i = 0; i < machines; ++i) keyed.emplace_back(base::random_at(stream, i), i);
  std::ranges::sort(keyed);
  std::vector<std::size_t> slices(machines);
  for (std::size_t slice = 0; slice < machines; ++slice) slices[keyed[slice].second] = slice;
  return slices;
}

// The value of an entry for a number drawn from its range. If `is_share`, the value is the entry's
// nominal value times this number.
machine::EntryValue make_value(const machine::Entry& entry, double number, bool is_share) {
  if (!is_share) return number;
  if (entry.formula.empty()) return entry.value * number;
  return fmt::format("({}) * {}", entry.formula, number);
}

// The factor for a calibrated entry that compensates for the other drawn entries in `set`: with it,
// the entry's formula `holds` has the same value as in the model `before`. The formula is linear in
// the entry, so two evaluations determine the factor.
double fit_to_held(const machine::Entry& entry, const machine::Model& before,
                   machine::Overrides set,
                   const std::function<machine::Model(const machine::Overrides&)>& make) {
  const auto where = entry.where + ": holds";
  const double held = eval(before, entry.holds, where);
  const double at_one = eval(make(set), entry.holds, where);
  set.emplace_back(entry.key, make_value(entry, 2, /*is_share=*/true));
  const double slope = eval(make(set), entry.holds, where) - at_one;
  const double share = 1 + (held - at_one) / slope;
  set.back().second = make_value(entry, share, /*is_share=*/true);
  const bool is_line =
      slope > 0 && share > 0 && std::abs(eval(make(set), entry.holds, where) / held - 1) < 1e-9;
  base::require(is_line, where,
                "expected a formula that is linear in {} and whose other terms do not exceed the "
                "quantity that it holds fixed",
                entry.key);
  return share;
}

}  // namespace

std::vector<double> draw_quantiles(std::uint64_t seed, const std::string& entry,
                                   std::size_t machines) {
  const std::uint64_t stream = base::random_at(seed, number_of(entry));
  const auto slices = shuffle_slices(stream, machines);
  std::vector<double> quantiles;
  for (std::size_t machine = 0; machine < machines; ++machine) {
    const std::uint64_t random = base::random_at(~stream, machine);
    const double within = (static_cast<double>(random >> 11) + 0.5) * 0x1p-53;
    quantiles.push_back((static_cast<double>(slices[machine]) + within) /
                        static_cast<double>(machines));
  }
  return quantiles;
}

double find_in(const machine::Range& range, double quantile) {
  if (range.is_share) return range.low * std::pow(range.high / range.low, quantile);
  return range.low + (range.high - range.low) * quantile;
}

machine::Overrides draw_machine(const std::string& model, const machine::Overrides& set,
                                const std::function<double(const std::string& entry)>& quantile) {
  const auto make = [&](const machine::Overrides& entries) {
    return entries.empty() ? machine::load_model(model)
                           : machine::override_model(model, entries, "[uncertain]");
  };
  const auto before = make(set);
  machine::Overrides drawn = set;
  // calibrated entries, each with the number that was drawn for it
  std::vector<std::pair<const machine::Entry*, double>> fitted;
  for (const auto& entry : before.entries) {
    if (!entry.range || is_set(set, entry.key)) continue;
    const double number = find_in(*entry.range, quantile(entry.key));
    if (entry.holds.empty())
      drawn.emplace_back(entry.key, make_value(entry, number, entry.range->is_share));
    else
      fitted.emplace_back(&entry, number);
  }
  const machine::Overrides unfitted = drawn;
  for (const auto& [entry, number] : fitted) {
    const double drawn_share = entry->range->is_share ? number : number / entry->value;
    const double share = fit_to_held(*entry, before, unfitted, make) * drawn_share;
    drawn.emplace_back(entry->key, make_value(*entry, share, /*is_share=*/true));
  }
  return drawn;
}

std::vector<std::string> drawn_entries(const ExperimentFile& file) {
  std::vector<std::string> entries;
  std::set<std::string> seen;
  for (const auto& point : file.points) {
    for_each_model(point.experiment, [&](const ModelSpec& spec) {
      if (!seen.insert(model_key(spec)).second) return;
      for (const auto& entry : make_model(spec).entries)
        if (entry.range && !is_set(spec.entries, entry.key) &&
            std::ranges::find(entries, entry.key) == entries.end())
          entries.push_back(entry.key);
    });
  }
  return entries;
}

ExperimentFile spread(const ExperimentFile& file) {
  const auto machines = static_cast<std::size_t>(file.uncertain.machines);
  if (machines == 0) return file;
  base::require((machines + 1) * file.points.size() <= MOST_POINTS, "uncertain.machines",
                "found {} machines for {} points, expected at most {} points of all machines",
                machines, file.points.size(), MOST_POINTS);
  ExperimentFile all = file;
  all.sweep.push_back({{"machine", "uncertain.machine", {}}});
  const auto seed = static_cast<std::uint64_t>(file.uncertain.seed);
  // for each entry, its quantile on each machine
  std::map<std::string, std::vector<double>> quantiles;
  for (const auto& entry : drawn_entries(file))
    quantiles[entry] = draw_quantiles(seed, entry, machines);
  for (std::size_t machine = 0; machine < machines; ++machine) {
    const auto number = make_node(static_cast<std::int64_t>(machine + 1));
    // the overrides that realise this machine, for each model in the file
    std::map<std::string, machine::Overrides> known;
    for (Point point : file.points) {
      const auto draw = [&](ModelSpec& spec) {
        auto [found, is_new] = known.try_emplace(model_key(spec));
        if (is_new)
          found->second = draw_machine(spec.source.path, spec.entries, [&](const auto& entry) {
            return quantiles.at(entry)[machine];
          });
        spec.entries = found->second;
      };
      draw(point.experiment.model);
      // the engine "direct" takes half the time, and its results differ only by rounding
      point.experiment.engine = {.links = machine::Links::direct};
      for (auto& other : point.experiment.others) draw(other.model);
      point.at.push_back({"machine", "uncertain.machine", number});
      all.points.push_back(std::move(point));
    }
  }
  return all;
}

}  // namespace laboratory
