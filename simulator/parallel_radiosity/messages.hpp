#pragma once
// Messages between the processes of AMP.
#include <variant>

#include "renderer/radiosity/light/solve.hpp"
#include "simulator/shared_memory/data_manager.hpp"

namespace parallel_radiosity {

/// The process number of all AMP processes in addresses.
constexpr int AMP_PROCESS = shared_memory::FIRST_FREE_PROCESS;

/// Sent up the tree: the brightest patch of a subtree, and the subtree's unshot light.
struct Candidate {
  std::optional<radiosity::Shot> shot;  ///< absent if no patch has light left
  radiosity::Unshot unshot;

  /// Merges candidates of two subtrees: keeps the brighter patch, or the one with the lower number
  /// if equally bright. The order of merging therefore does not matter.
  Candidate& operator+=(const Candidate& other);
};
/// Broadcast by the root instead of a radiosity::Shot: the solution is complete.
struct Stop {};
/// Sent to a processor that shares vertices: the light that these vertices received from the shot.
/// `first` is the index of the first one in the sender's Border.
struct Given {
  std::size_t first = 0;
  std::vector<radiosity::Rgb> values;
};
/// Sent by the display to a processor: requests the radiosity of the processor's vertices, from
/// index `first` of its share on.
struct Show {
  std::size_t first = 0;
};
/// Reply to Show: as many values as fit into a message, from index `first` on.
struct Displayed {
  std::size_t first = 0;
  std::vector<radiosity::Rgb> values;
};

using AmpMessage = std::variant<Candidate, radiosity::Shot, Given, Show, Displayed, Stop>;
/// Number of colours in a message.
std::size_t count_colours(const AmpMessage& content);

/// Lengths of messages in bytes, from the model's [bytes] radiosity_*. A shot has one colour, or
/// one for each corner.
struct MessageBytes {
  MessageBytes(const machine::Model& model, radiosity::Sends sends);
  std::uint64_t candidate, shot, colour;
  static constexpr std::uint64_t WORD = 4;
  static constexpr std::size_t MOST = 64;  ///< maximum number of values in a message

  std::uint64_t of(const AmpMessage& content) const;
  std::uint64_t longest() const;
};

}  // namespace parallel_radiosity
