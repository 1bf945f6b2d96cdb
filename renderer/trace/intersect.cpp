#include "renderer/trace/intersect.hpp"

#include "renderer/trace/walk.hpp"

namespace renderer {

std::optional<Hit> intersect(const Scene& scene, const Ray& ray, Traversal traversal, Work& work) {
  return walking::find(scene, ray, traversal, work, walking::Nobody{});
}

}  // namespace renderer
