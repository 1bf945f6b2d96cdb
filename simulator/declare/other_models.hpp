#pragma once
// Processors of one machine that are of different models.
#include <map>
#include <memory>

#include "simulator/machine/model.hpp"

namespace programs {

/// The models of processors that are not of the machine's model, by their number in the topology.
using OtherModels = std::map<int, std::shared_ptr<const machine::Model>>;

/// Null for a processor of the machine's model, as Machine::add_processor takes it.
inline std::shared_ptr<const machine::Model> find_model(const OtherModels& others, int id) {
  const auto found = others.find(id);
  return found == others.end() ? nullptr : found->second;
}

/// The model of a processor.
inline const machine::Model& model_of(const OtherModels& others, int id,
                                      const machine::Model& machines) {
  const auto own = find_model(others, id);
  return own ? *own : machines;
}

}  // namespace programs
