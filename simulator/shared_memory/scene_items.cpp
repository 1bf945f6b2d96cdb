#include "simulator/shared_memory/scene_items.hpp"

#include <cmath>

namespace shared_memory {

namespace {

Catalogue make_scene_catalogue(const machine::Model& model, const renderer::Scene& scene) {
  return Catalogue({std::vector(box_count(scene), get_bytes(model, "box")),
                    std::vector(object_count(scene), get_bytes(model, "object"))});
}

}  // namespace

SceneItems::SceneItems(const machine::Model& model, const renderer::Scene& scene)
    : catalogue_(make_scene_catalogue(model, scene)) {
  int number = 0;
  for (const auto& box : scene.hierarchy.boxes) {
    number_of_box_.push_back(number);
    number += box.item == renderer::Box::INNER;
  }
  const std::size_t sizes[] = {scene.spheres.size(), scene.polygons.size(), scene.patches.size()};
  for (std::size_t kind = 0; kind < std::size(sizes); ++kind)
    first_of_kind_[kind + 1] = first_of_kind_[kind] + static_cast<int>(sizes[kind]);
}

void SceneReader::charge(const renderer::Work& done) {
  Cycles all = costs_(done.counts);
  if (scale_ != 1) all = Cycles{std::llround(scale_ * static_cast<double>(all.value))};
  machine::this_process().charge(Cycles{all.value - charged_.value});
  charged_ = all;
}

}  // namespace shared_memory
