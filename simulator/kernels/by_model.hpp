#pragma once
// Costs on a machine with processors of different models.
#include <deque>
#include <functional>
#include <utility>

#include "simulator/machine/machine.hpp"

namespace kernels {

/// A cost, or a set of costs, for each processor model. Each is made once, on first use.
template <class T>
class ByModel {
 public:
  using Make = std::function<T(const machine::Model&)>;
  /// Calls `make` for `model` immediately, so that missing entries throw BadInput here.
  ByModel(const machine::Model& model, Make make) : make_(std::move(make)) { make_(model); }

  /// The cost on the processor of this_process(). The reference stays valid.
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
