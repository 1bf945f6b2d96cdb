#include "simulator/radiosity/messages.hpp"

namespace amp {

Candidate& Candidate::operator+=(const Candidate& other) {
  unshot += other.unshot;
  const auto& theirs = other.shot;
  if (theirs && (!shot || theirs->power > shot->power ||
                 (theirs->power == shot->power && theirs->patch < shot->patch)))
    shot = theirs;
  return *this;
}

MessageBytes::MessageBytes(const machine::Model& model)
    : candidate(get_bytes(model, "radiosity_candidate")),
      shot(get_bytes(model, "radiosity_shot")),
      colour(get_bytes(model, "colour")) {}

std::uint64_t MessageBytes::of(const AmpMessage::Content& content) const {
  if (std::holds_alternative<Candidate>(content)) return candidate;
  if (std::holds_alternative<radiosity::Shot>(content)) return shot;
  if (const auto* shown = std::get_if<Shown>(&content))
    return 2 * WORD + shown->values.size() * colour;
  if (const auto* given = std::get_if<Given>(&content))
    return 2 * WORD + given->values.size() * colour;
  return 2 * WORD;
}

std::uint64_t MessageBytes::longest() const {
  return std::max({candidate, shot, 2 * WORD + MOST * colour});
}

}  // namespace amp
