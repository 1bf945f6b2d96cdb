#pragma once
// Sizes of the records that are stored and sent, from the model file.
#include "renderer/scene/scene.hpp"
#include "simulator/machine/model.hpp"

namespace kernels {

/// Sizes of a ray, of what it hits and of a pixel, in bytes.
struct RecordBytes {
  std::uint32_t ray = 0, hit = 0, pixel = 0;
};
RecordBytes record_bytes(const machine::Model& model);

/// Bytes of a copy of the scene: its objects and their hierarchy.
std::uint64_t scene_bytes(const machine::Model& model, const renderer::Scene& scene);

}  // namespace kernels
