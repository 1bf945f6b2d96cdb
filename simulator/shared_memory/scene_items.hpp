#pragma once
// A scene as items of virtual shared memory: boxes of its hierarchy ("clusters") and objects are
// items (5.1.2.1). Surfaces, lights and the view are embedded in every processor.
#include "renderer/trace/intersect.hpp"
#include "simulator/shared_memory/data_manager.hpp"

namespace shared_memory {

/// Item classes.
constexpr int BOX_ITEMS = 0, OBJECT_ITEMS = 1;

class SceneItems {
 public:
  /// The model gives the records' sizes. Objects are numbered kind by kind in the order of the
  /// hierarchy's leaves, boxes depth first, so neighbours have close numbers.
  SceneItems(const machine::Model& model, const renderer::Scene& scene);

  const Catalogue& catalogue() const { return catalogue_; }
  Item box(std::uint32_t index) const { return {BOX_ITEMS, number_of_box_[index]}; }
  Item object(renderer::Place place) const {
    return {OBJECT_ITEMS, first_of_kind_[static_cast<std::size_t>(place.kind())] +
                              static_cast<int>(place.index())};
  }

 private:
  Catalogue catalogue_;
  std::vector<int> number_of_box_;  // by index in the hierarchy, including leaves
  std::array<int, 4> first_of_kind_{};
};

/// A kernel's reads of the scene through a data manager. Charges the work counted so far before
/// each read, so that time passes as in a program that computes between accesses.
class SceneReader : public renderer::Access {
 public:
  /// `scale`: factor on the cost of counted work, to match a timed kernel's duration.
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
  /// Charges this_process() the part of `done` that was not charged yet.
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
