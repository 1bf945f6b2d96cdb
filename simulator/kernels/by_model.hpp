#pragma once
// Costs on a machine whose processors have different models.
#include <deque>
#include <functional>
#include <utility>

#include "simulator/machine/machine.hpp"

namespace kernels {

/// Values of type T, one for each processor model. A value is a cost or a set of costs, and is made
/// at its first use.
template <class T>
class ByModel {
 public:
  using Make = std::function<T(const machine::Model&)>;
  /// Also calls `make` for `model` at once. If `model` lacks an entry, this call throws BadInput.
  ByModel(const machine::Model& model, Make make) : make_(std::move(make)) { make_(model); }

  /// Returns the cost on the processor of this_process(). The reference stays valid.
  const T& here() const {
    const auto& model = machine::this_process().processor().model();
    for (const auto& [known, cost] : known_)
      if (known == &model) return cost;
    return known_.emplace_back(&model, make_(model)).second;
  }

 private:
  Make make_;
  mutable std::deque<std::pair<const machine::Model*, T>> known_;
};

}  // namespace kernels
