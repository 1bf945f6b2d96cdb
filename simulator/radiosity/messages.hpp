#pragma once
// What the processes of AMP say to each other.
#include <variant>

#include "renderer/radiosity/light/solve.hpp"
#include "simulator/machine/model.hpp"
#include "simulator/shared_memory/data_messages.hpp"

namespace amp {

// The second level of the address of all of them.
constexpr int AMP_PROCESS = shared_memory::FIRST_FREE_PROCESS;

// Up the tree: the brightest patch of those below, and what is unsent there.
struct Candidate {
  std::optional<radiosity::Shot> shot;  // none: all are dark
  radiosity::Unshot unshot;

  // Of two shots the brighter, of equals the one of the lower patch: whatever the order.
  Candidate& operator+=(const Candidate& other);
};
// To all: it is over. (To all goes radiosity::Shot, too.)
struct Stop {};
// To who shares vertices: what they got of the shot, of Share::out's from `first` on.
struct Given {
  std::size_t first = 0;
  std::vector<radiosity::Rgb> values;
};
// From the display to one: its vertices' radiosity from this one of its share on.
struct Show {
  std::size_t first = 0;
};
// And back: so many, from there on.
struct Shown {
  std::size_t first = 0;
  std::vector<radiosity::Rgb> values;
};

struct AmpMessage : network::Contents {
  using Content = std::variant<Candidate, radiosity::Shot, Given, Show, Shown, Stop>;
  explicit AmpMessage(Content content) : content(std::move(content)) {}
  Content content;
};

// Lengths of messages (the model's [bytes] radiosity_*).
struct MessageBytes {
  explicit MessageBytes(const machine::Model& model);
  std::uint64_t candidate, shot, colour;
  static constexpr std::uint64_t WORD = 4;
  static constexpr std::size_t MOST = 64;  // values of a message

  std::uint64_t of(const AmpMessage::Content& content) const;
  std::uint64_t longest() const;
};

}  // namespace amp
