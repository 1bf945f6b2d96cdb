#pragma once
// Counts of work, as the commands' --stats write them.
#include <nlohmann/json.hpp>

#include "renderer/scene/work.hpp"

namespace laboratory {

inline nlohmann::ordered_json make_json(const renderer::Work& work) {
  nlohmann::ordered_json counts;
  for (std::size_t i = 0; i < renderer::OP_COUNT; ++i)
    counts[std::string(renderer::op_names()[i])] = work.counts[i];
  return counts;
}

}  // namespace laboratory
