#pragma once
// Messages between the farm's processes: the protocols of the channels in figure 4.9 of the thesis.
#include <memory>
#include <optional>
#include <variant>

#include "renderer/trace/render.hpp"
#include "simulator/farm/rays/ray_stores.hpp"
#include "simulator/kernels/kernels.hpp"
#include "simulator/occam/channel.hpp"
#include "simulator/ray_tracing/session.hpp"

namespace farm {

using occam::Channel;
using occam::Signal;
using ray_tracing::Abort;
using ray_tracing::Interactive;
using ray_tracing::NonInteractive;
using ray_tracing::Save;

constexpr std::uint32_t TAG_BYTES = 4;      ///< a message without contents: one word
constexpr std::uint32_t LIMITS_BYTES = 32;  ///< parameters of increasing realism (Limits): 8 words
constexpr std::uint32_t BLOCK_BYTES = TAG_BYTES + 4 * 4;  ///< position and size of a block

/// Length of a FinishedPixel: the tag, the pixel's number and three sums of 8 bytes each.
constexpr std::uint32_t FINISHED_BYTES = TAG_BYTES + 4 + 3 * 8;

constexpr std::uint32_t WEIGHTS_BYTES = 12;  ///< added to LIMITS_BYTES if the limits have weights
inline std::uint32_t bytes_of(const Limits& limits) {
  return LIMITS_BYTES + (limits.weights ? WEIGHTS_BYTES : 0);
}

/// Ends the receiving process, which first forwards the message.
struct Stop {
  bool operator==(const Stop&) const = default;
};

/// Message with a part of the scene for every worker, or of surfaces and lights for the display.
struct SceneData {
  bool is_last = false;  ///< true for the last part, which the receiver must acknowledge
};

/// The size of a block of pixels, if tasks are blocks.
struct Block {
  int width = 0, height = 0;  ///< in pixels
};

/// Coordination -> workers: a ray or a block of pixels. Messages for all workers (Stop, SceneData)
/// are copied to every branch of the spanning tree.
struct Task {
  std::variant<Stop, SceneData, renderer::Ray, renderer::Area> content;
  std::uint32_t size = TAG_BYTES;
  std::uint64_t bytes() const { return size; }
  bool stop() const { return std::holds_alternative<Stop>(content); }
  bool is_for_all() const { return stop() || std::holds_alternative<SceneData>(content); }
};

/// A ray and its first intersection.
struct Intersection {
  renderer::Ray ray;
  std::optional<renderer::Hit> hit;
};
using RenderedBlock = std::shared_ptr<const renderer::Block>;
struct SceneReceived {};
struct KeepImage {   ///< to the visualisation process only: saves the picture as it is now
  std::string name;  ///< file name; its simulated length is one word
};

/// Message from workers to coordination, and from there to visualisation.
struct Answer {
  std::variant<Stop, SceneReceived, SceneData, KeepImage, FinishedPixel, Intersection,
               RenderedBlock>
      content;
  std::uint32_t size = TAG_BYTES;
  std::uint64_t bytes() const { return size; }
  bool stop() const { return std::holds_alternative<Stop>(content); }
};

// Messages to and from the ray database, and to the display, use occam's variant protocols (thesis,
// figures 4.16 and 4.17: `add.ray; ray.mess`). In these protocols the tag is a separate word, so
// the sizes exclude it. Stop and KeepImage count as one word.

struct AskInteractive {};  ///< requests a ray within the limits (ask.interact.mode.ray)
struct AskAny {};          ///< requests any stored ray (ask.any.ray)

/// Sets new limits. `order` is the number of the user's order that set them, or 0.
struct SetLimits {
  Limits limits;
  std::uint8_t order = 0;
};

/// Request from coordination to the ray database.
struct DatabaseRequest {
  std::variant<Stop, AskInteractive, AskAny, renderer::Ray, SetLimits> content;
  std::uint32_t size = 0;
  std::uint64_t bytes() const { return size; }
};

/// Ray database -> coordination: a ray, or nothing if no suitable ray is stored (`error;
/// DB.empty`).
struct DatabaseReply {
  std::optional<renderer::Ray> ray;
  std::uint32_t size = TAG_BYTES;
  std::uint64_t bytes() const { return size; }
};

struct Begin {};           ///< stores the initial rays and starts the interactive phase
using ray_tracing::Leave;  ///< ends the farm when the image is complete

/// Interaction -> coordination: an order of the user.
struct Command {
  std::variant<Begin, NonInteractive, Interactive, Abort, Leave, Save, Limits> content;
  std::uint64_t bytes() const {
    const auto* limits = std::get_if<Limits>(&content);
    return limits ? bytes_of(*limits) : TAG_BYTES;
  }
};

}  // namespace farm
