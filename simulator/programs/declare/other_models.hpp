#pragma once
// Processors of different models in one machine.
#include <map>
#include <memory>

#include "simulator/machine/model.hpp"

namespace programs {

/// The models that differ from the machine's model, by number of the processor in the topology.
using OtherModels = std::map<int, std::shared_ptr<const machine::Model>>;

/// The model to pass to Machine::add_processor: null for a processor with the machine's model.
inline std::shared_ptr<const machine::Model> find_model(const OtherModels& others, int id) {
  const auto found = others.find(id);
  return found == others.end() ? nullptr : found->second;
}

/// The model of processor `id`: its own model if it has one, else `machines`, the model of the
/// machine.
inline const machine::Model& model_of(const OtherModels& others, int id,
                                      const machine::Model& machines) {
  const auto own = find_model(others, id);
  return own ? *own : machines;
}

}  // namespace programs
