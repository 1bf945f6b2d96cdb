#pragma once
// Each key of the experiment file is declared once, bound to the field it sets.
#include <toml++/toml.h>

#include "experiments/experiment.hpp"

namespace experiments {

// A value that takes the place of a key's own.
struct Replacement {
  std::string key;
  const toml::node* value;
};

// Sets every field that `file` names, then the replacements; `folder` is what paths are relative
// to. Throws machine::InvalidInput for an unknown key or a value of the wrong kind, with `origin`
// and line.
Experiment bind_settings(const toml::table& file, const std::vector<Replacement>& replacements,
                         const std::string& origin, const std::string& folder);

// The key whose last part is `axis`; throws machine::InvalidInput with the nearest.
std::string key_of_axis(std::string_view axis, const std::string& origin);

}  // namespace experiments
