#include "simulator/parallel_radiosity/messages.hpp"

#include "simulator/occam/case_of.hpp"

namespace parallel_radiosity {

namespace {

template <class Part>
std::size_t colours_of(const Part& part) {
  if constexpr (requires { part.values; })
    return part.values.size();
  else
    return 0;
}

}  // namespace

std::size_t count_colours(const AmpMessage& content) {
  return occam::case_of(content, [](const auto& part) { return colours_of(part); });
}

Candidate& Candidate::operator+=(const Candidate& other) {
  unshot += other.unshot;
  const auto& theirs = other.shot;
  if (theirs && (!shot || theirs->power > shot->power ||
                 (theirs->power == shot->power && theirs->patch < shot->patch)))
    shot = theirs;
  return *this;
}

MessageBytes::MessageBytes(const machine::Model& model, radiosity::Sends sends)
    : candidate(get_bytes(model, "radiosity_candidate")),
      shot(get_bytes(model, "radiosity_shot")),
      colour(get_bytes(model, "colour")) {
  if (sends == radiosity::Sends::mean) return;
  candidate += 3 * colour;
  shot += 3 * colour;
}

std::uint64_t MessageBytes::of(const AmpMessage& content) const {
  return occam::case_of(
      content, [&](const Candidate&) { return candidate; },
      [&](const radiosity::Shot&) { return shot; },
      [&](const auto& other) { return 2 * WORD + colours_of(other) * colour; });
}

std::uint64_t MessageBytes::longest() const {
  return std::max({candidate, shot, 2 * WORD + MOST * colour});
}

}  // namespace parallel_radiosity
