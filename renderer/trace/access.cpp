#include "renderer/trace/access.hpp"

#include "renderer/trace/walk.hpp"

namespace renderer {

namespace {

// Passes on what a walk reads, with counts that are up to date.
struct Somebody {
  static constexpr bool LISTENS = true;
  Access& access;
  Work& work;

  void box(walking::Walk& walk, std::uint32_t index) const {
    count(walk, work);
    access.box(index, work);
  }
  void object(walking::Walk& walk, Place place) const {
    count(walk, work);
    access.object(place, work);
  }
};

}  // namespace

std::optional<Hit> intersect(const Scene& scene, const Ray& ray, Traversal traversal, Work& work,
                             Access& access) {
  return walking::find(scene, ray, traversal, work, Somebody{access, work});
}

}  // namespace renderer
