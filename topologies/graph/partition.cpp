#include "topologies/graph/partition.hpp"

#include <metis.h>

#include <algorithm>

#include "base/errors.hpp"

namespace topologies {

namespace {

// Renumbers the parts from 0 without gaps, in the order of their lowest processors.
void number_anew(std::vector<idx_t>& parts) {
  std::map<idx_t, idx_t> numbers;
  for (idx_t& part : parts)
    part = numbers.try_emplace(part, static_cast<idx_t>(numbers.size())).first->second;
}

}  // namespace

std::vector<int> make_partition(const Topology& topology, int parts) {
  auto processors = static_cast<idx_t>(topology.processors);
  auto count = std::min(static_cast<idx_t>(parts), processors);
  std::vector<idx_t> part_of(processors, 0);
  if (count == 1) return {part_of.begin(), part_of.end()};
  // adjacency lists for METIS, which calls them xadj and adjncy
  std::vector<idx_t> begins{0}, ends;
  for (const auto& around : neighbours(topology)) {
    for (const Neighbour& neighbour : around) ends.push_back(neighbour.processor);
    begins.push_back(static_cast<idx_t>(ends.size()));
  }
  idx_t options[METIS_NOPTIONS], weights = 1, cut = 0;
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  const int status =
      METIS_PartGraphKway(&processors, &weights, begins.data(), ends.data(), nullptr, nullptr,
                          nullptr, &count, nullptr, nullptr, options, &cut, part_of.data());
  if (status != METIS_OK)
    throw base::InvariantBroken(fmt::format(
        "METIS failed to make {} parts of {} processors: status {}", count, processors, status));
  number_anew(part_of);
  return {part_of.begin(), part_of.end()};
}

}  // namespace topologies
