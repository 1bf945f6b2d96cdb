#pragma once
// A scene as items of virtual shared memory. The items are the objects and the boxes of their
// bounding hierarchy ("clusters"; thesis, 5.1.2.1). Surfaces, lights and the view are not items:
// every processor holds all of them.
#include "renderer/trace/intersect.hpp"
#include "simulator/shared_memory/data_manager.hpp"

namespace shared_memory {

/// Item classes.
constexpr int BOX_ITEMS = 0, OBJECT_ITEMS = 1;

class SceneItems {
 public:
  /// The model determines the sizes of records. Objects are numbered kind by kind, in the order of
  /// the hierarchy's leaves; boxes are numbered depth first. Objects or boxes that are close to
  /// each other therefore have close numbers.
  SceneItems(const machine::Model& model, const renderer::Scene& scene);

  const Catalogue& catalogue() const { return catalogue_; }
  Item box(std::uint32_t index) const { return {BOX_ITEMS, number_of_box_[index]}; }
  Item object(renderer::Place place) const {
    return {OBJECT_ITEMS, first_of_kind_[static_cast<std::size_t>(place.kind())] +
                              static_cast<int>(place.index())};
  }

 private:
  Catalogue catalogue_;
  std::vector<int> number_of_box_;  // by index in the hierarchy, which includes leaves
  std::array<int, 4> first_of_kind_{};
};

/// Reads the scene for a kernel through a data manager. Before each read, charges the work counted
/// since the previous read, so that simulated time passes between accesses as it would in the
/// program.
class SceneReader : public renderer::Access {
 public:
  /// `scale` is a factor on the cost of counted work. If costs are host times, this factor makes
  /// the sum of the charged costs equal to the kernel's measured time.
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
  /// Charges this_process() with the part of the work `done` that has not been charged yet.
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
