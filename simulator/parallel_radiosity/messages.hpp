#pragma once
// Messages between the application processes of AMP, the radiosity system of the thesis's chapter
// 5.1.
#include <variant>

#include "renderer/radiosity/light/solve.hpp"
#include "simulator/shared_memory/data_manager.hpp"

namespace parallel_radiosity {

/// Number of the application process in network addresses, the same on all processors.
constexpr int AMP_PROCESS = shared_memory::FIRST_FREE_PROCESS;

/// Sent up the tree: the brightest patch of a subtree, and the light that the subtree has not yet
/// shot.
struct Candidate {
  std::optional<radiosity::Shot> shot;  ///< nothing if no patch of the subtree has light left
  radiosity::Unshot unshot;

  /// Merges the candidates of two subtrees: keeps the brighter patch, or if both are equally bright
  /// the one with the lower number. The result does not depend on the order of merging.
  Candidate& operator+=(const Candidate& other);
};
/// Broadcast by the root in place of a radiosity::Shot when the solution is complete.
struct Stop {};
/// Sent to a processor that shares vertices with the sender: the light that these vertices received
/// from the present shot. `first` is the index of the first of them in the sender's Border.
struct Given {
  std::size_t first = 0;
  std::vector<radiosity::Rgb> values;
};
/// Sent by the display to a processor: requests the radiosity of the processor's vertices, from
/// index `first` of its Share::vertices on.
struct Show {
  std::size_t first = 0;
};
/// Reply to Show: as many values as fit into a message, starting at index `first`.
struct Displayed {
  std::size_t first = 0;
  std::vector<radiosity::Rgb> values;
};

using AmpMessage = std::variant<Candidate, radiosity::Shot, Given, Show, Displayed, Stop>;
/// Number of colours in a message.
std::size_t count_colours(const AmpMessage& content);

/// Lengths of messages in bytes, from the entries bytes.radiosity_* of the model. A shot carries
/// one colour, or one for each corner of the patch.
struct MessageBytes {
  MessageBytes(const machine::Model& model, radiosity::Sends sends);
  std::uint64_t candidate, shot, colour;
  static constexpr std::uint64_t WORD = 4;
  static constexpr std::size_t MOST = 64;  ///< maximum number of colours in a message

  std::uint64_t of(const AmpMessage& content) const;
  std::uint64_t longest() const;
};

}  // namespace parallel_radiosity
