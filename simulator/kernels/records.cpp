#include "simulator/kernels/records.hpp"

namespace kernels {

RecordBytes record_bytes(const machine::Model& model) {
  const auto get = [&](const char* name) {
    return static_cast<std::uint32_t>(get_bytes(model, name));
  };
  return {get("ray"), get("hit"), get("pixel")};
}

std::uint64_t scene_bytes(const machine::Model& model, const renderer::Scene& scene) {
  return object_count(scene) * get_bytes(model, "object") +
         box_count(scene) * get_bytes(model, "box");
}

}  // namespace kernels
