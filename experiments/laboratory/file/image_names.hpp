#pragma once
// How the command line and experiment files call the choices of an image.
#include <string>
#include <utility>
#include <vector>

#include "renderer/trace/shade.hpp"

namespace laboratory {

template <class Enum>
using Names = std::vector<std::pair<std::string, Enum>>;

inline const Names<renderer::Feelers> FEELERS = {{"all", renderer::Feelers::all},
                                                 {"front", renderer::Feelers::front}};
inline const Names<renderer::SamplePosition> SAMPLES = {
    {"center", renderer::SamplePosition::center},
    {"corner", renderer::SamplePosition::corner},
    {"lattice", renderer::SamplePosition::lattice}};
inline const Names<renderer::Traversal> TRAVERSALS = {
    {"exhaustive", renderer::Traversal::exhaustive},
    {"nearest", renderer::Traversal::nearest},
    {"linear", renderer::Traversal::linear}};

template <class Enum>
std::vector<std::string> keys_of(const Names<Enum>& names) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : names) keys.push_back(key);
  return keys;
}

}  // namespace laboratory
