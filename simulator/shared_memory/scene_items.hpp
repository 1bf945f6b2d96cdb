#pragma once
// A scene as items of virtual shared memory: the boxes of its hierarchy ("clusters") are accessed
// as its objects are (5.1.2.1). Surfaces, lights and the view are embedded: every processor has
// them.
#include "renderer/trace/intersect.hpp"
#include "simulator/shared_memory/data_manager.hpp"

namespace shared_memory {

/// Classes of items.
constexpr int BOX_ITEMS = 0, OBJECT_ITEMS = 1;

class SceneItems {
 public:
  /// Sizes of records are the model's. Objects are numbered kind by kind in the order of the
  /// hierarchy's leaves, boxes depth first: neighbours are near to each other.
  SceneItems(const machine::Model& model, const renderer::Scene& scene);

  const Catalogue& catalogue() const { return catalogue_; }
  Item box(std::uint32_t index) const { return {BOX_ITEMS, number_of_box_[index]}; }
  Item object(renderer::Place place) const {
    return {OBJECT_ITEMS, first_of_kind_[static_cast<std::size_t>(place.kind())] +
                              static_cast<int>(place.index())};
  }

 private:
  Catalogue catalogue_;
  std::vector<int> number_of_box_;  // by index in the hierarchy, where leaves have places too
  std::array<int, 4> first_of_kind_{};
};

/// A kernel's reads of the scene, by way of a data manager. What the kernel has counted is charged
/// before each: time passes as in a program that computes between its accesses.
class SceneReader : public renderer::Access {
 public:
  /// `scale` multiplies the costs of what is counted: a timed kernel takes as long as it takes.
  SceneReader(const SceneItems& items, DataManager& manager, const machine::OperationCosts& costs,
              double scale)
      : items_(items), manager_(manager), costs_(costs), scale_(scale) {}

  void box(std::uint32_t index, const renderer::Work& done) override {
    charge(done);
    manager_.access(items_.box(index));
  }
  void object(renderer::Place place, const renderer::Work& done) override {
    charge(done);
    manager_.access(items_.object(place));
  }
  /// Charges this_process() what has not been charged yet of all that is done.
  void charge(const renderer::Work& done);
  Cycles charged() const { return charged_; }

 private:
  const SceneItems& items_;
  DataManager& manager_;
  const machine::OperationCosts& costs_;
  const double scale_;
  Cycles charged_{};
};

}  // namespace shared_memory
