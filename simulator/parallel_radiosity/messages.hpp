#pragma once
// Messages between the processes of AMP.
#include <variant>

#include "renderer/radiosity/light/solve.hpp"
#include "simulator/shared_memory/data_manager.hpp"

namespace parallel_radiosity {

/// Second level of the addresses of all AMP processes.
constexpr int AMP_PROCESS = shared_memory::FIRST_FREE_PROCESS;

/// Up the tree: the brightest patch of a subtree, and its unsent light.
struct Candidate {
  std::optional<radiosity::Shot> shot;  ///< none if all patches are dark
  radiosity::Unshot unshot;

  /// Keeps the brighter shot, or the lower patch of equally bright ones, so that the order of
  /// candidates does not matter.
  Candidate& operator+=(const Candidate& other);
};
/// Broadcast, like radiosity::Shot: the solution is complete.
struct Stop {};
/// To a processor that shares vertices: light they received from the shot, starting at index
/// `first` of Share::out.
struct Given {
  std::size_t first = 0;
  std::vector<radiosity::Rgb> values;
};
/// From the display to a processor: requests its vertices' radiosity, starting at index `first` of
/// its share.
struct Show {
  std::size_t first = 0;
};
/// Reply: as many values as fit into a message, starting at `first`.
struct Displayed {
  std::size_t first = 0;
  std::vector<radiosity::Rgb> values;
};

struct AmpMessage : network::Contents {
  using Content = std::variant<Candidate, radiosity::Shot, Given, Show, Displayed, Stop>;
  explicit AmpMessage(Content content) : content(std::move(content)) {}
  Content content;
};
/// Number of colours in a message.
std::size_t count_colours(const AmpMessage::Content& content);

/// Message lengths in bytes (the model's [bytes] radiosity_*). A shot has one colour, or one per
/// corner.
struct MessageBytes {
  MessageBytes(const machine::Model& model, radiosity::Sends sends);
  std::uint64_t candidate, shot, colour;
  static constexpr std::uint64_t WORD = 4;
  static constexpr std::size_t MOST = 64;  ///< most values in a message

  std::uint64_t of(const AmpMessage::Content& content) const;
  std::uint64_t longest() const;
};

}  // namespace parallel_radiosity
