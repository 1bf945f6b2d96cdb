#pragma once
// What the processes of the farm say to each other: the protocols of figure 4.9's channels.
#include <memory>
#include <optional>
#include <variant>

#include "renderer/trace/render.hpp"
#include "renderer/trace/shade.hpp"
#include "simulator/farm/priority.hpp"
#include "simulator/kernels/records.hpp"
#include "simulator/occam/channel.hpp"

namespace farm {

using occam::Channel;
using occam::Signal;

constexpr std::uint32_t TAG_BYTES = 4;      // a message without contents: one word
constexpr std::uint32_t LIMITS_BYTES = 32;  // the parameters of increasing realism: 8 words

// Ends the process that receives it, after it has passed it on.
struct Stop {
  bool operator==(const Stop&) const = default;
};

// A part of the scene, for every worker.
struct SceneData {
  bool is_last = false;  // to be acknowledged
};

// Coordination -> workers: a task is one ray, or a block of pixels; what is for all of them goes
// down every way.
struct Task {
  std::variant<Stop, SceneData, renderer::Ray, renderer::Area> content;
  std::uint32_t size = TAG_BYTES;
  std::uint64_t bytes() const { return size; }
  bool stop() const { return std::holds_alternative<Stop>(content); }
  bool is_for_all() const { return stop() || std::holds_alternative<SceneData>(content); }
};
constexpr std::uint32_t BLOCK_BYTES = TAG_BYTES + 4 * 4;  // a block's task: where it is

// Workers -> coordination -> visualisation: a ray, and what it hits first; or a block. Also what
// acknowledges the scene.
struct Intersection {
  bool stop = true;
  bool key_image = false;  // to visualisation only: keep the image as it is now
  renderer::Ray ray;
  std::optional<renderer::Hit> hit;
  std::shared_ptr<const renderer::Block> block;  // instead of ray and hit
  std::uint32_t size = TAG_BYTES;
  std::uint64_t bytes() const { return size; }
};

inline Intersection make_intersection(const renderer::Ray& ray) {
  Intersection found;
  found.stop = false;
  found.ray = ray;
  return found;
}
// The scene has arrived.
inline Intersection make_acknowledgement() {
  Intersection message;
  message.stop = false;
  return message;
}
inline Intersection make_key_image() {
  Intersection message;
  message.stop = false;
  message.key_image = true;
  return message;
}

// To and from the ray database, and to the display, go occam's variant protocols (figures 4.16 and
// 4.17: `add.ray; ray.mess`): sizes are those of the contents, after the tag. (A stop and a key
// image have a word for contents.)

// Coordination -> ray database.
struct AskInteractive {};  // for an RMI ray (figure 4.16: ask.interact.mode.ray)
struct AskAny {};          // for any ray (ask.any.ray)
struct DatabaseRequest {
  std::variant<Stop, AskInteractive, AskAny, renderer::Ray, Limits> content;
  std::uint32_t size = 0;
  std::uint64_t bytes() const { return size; }
};

// Ray database -> coordination: a ray, or none of the kind asked for (`error; DB.empty`).
struct DatabaseReply {
  std::optional<renderer::Ray> ray;
  std::uint32_t size = TAG_BYTES;
  std::uint64_t bytes() const { return size; }
};

// Interaction -> coordination: what the user orders.
struct Begin {};           // deposit the initial rays, start the interactive phase
struct NonInteractive {};  // leave the interactive phase now
struct Quit {};            // end when the image is complete
struct Command {
  std::variant<Begin, NonInteractive, Quit, Limits> content;
  std::uint64_t bytes() const { return content.index() == 3 ? LIMITS_BYTES : TAG_BYTES; }
};

}  // namespace farm
