#pragma once
// What the processes of AMP say to each other.
#include <variant>

#include "renderer/radiosity/light/solve.hpp"
#include "simulator/shared_memory/data_manager.hpp"

namespace amp {

/// The second level of the address of all of them.
constexpr int AMP_PROCESS = shared_memory::FIRST_FREE_PROCESS;

/// Goes up the tree: the brightest patch of those below, and what is unsent there.
struct Candidate {
  std::optional<radiosity::Shot> shot;  ///< none if all are dark
  radiosity::Unshot unshot;

  /// Keeps the brighter of two shots, of equal ones that of the lower patch: the order of the
  /// candidates does not matter.
  Candidate& operator+=(const Candidate& other);
};
/// Goes to all, as radiosity::Shot does: the solution is complete.
struct Stop {};
/// Goes to a processor that shares vertices: the light that they got from the shot, from number
/// `first` of Share::out on.
struct Given {
  std::size_t first = 0;
  std::vector<radiosity::Rgb> values;
};
/// Goes from the display to a processor: asks for its vertices' radiosity from number `first` of
/// its share on.
struct Show {
  std::size_t first = 0;
};
/// Comes back: as many values as fit a message, from there on.
struct Shown {
  std::size_t first = 0;
  std::vector<radiosity::Rgb> values;
};

struct AmpMessage : network::Contents {
  using Content = std::variant<Candidate, radiosity::Shot, Given, Show, Shown, Stop>;
  explicit AmpMessage(Content content) : content(std::move(content)) {}
  Content content;
};
/// Number of colours in a message.
std::size_t count_colours(const AmpMessage::Content& content);

/// Lengths of messages in bytes (the model's [bytes] radiosity_*). A shot has one colour, or one
/// for each corner.
struct MessageBytes {
  MessageBytes(const machine::Model& model, radiosity::Sends sends);
  std::uint64_t candidate, shot, colour;
  static constexpr std::uint64_t WORD = 4;
  static constexpr std::size_t MOST = 64;  ///< values of a message

  std::uint64_t of(const AmpMessage::Content& content) const;
  std::uint64_t longest() const;
};

}  // namespace amp
