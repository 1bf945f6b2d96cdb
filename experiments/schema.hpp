#pragma once
// Each key of the experiment file is declared once, bound to the field it sets.
#include <toml++/toml.h>

#include "experiments/experiment.hpp"

namespace experiments {

// Sets every field that `file` names; `folder` is what its paths are relative to. Throws
// machine::InvalidInput for an unknown key or a value of the wrong kind, with `origin` and line.
Experiment bind_settings(const toml::table& file, const std::string& origin,
                         const std::string& folder);

// The key whose last part is `axis`; throws machine::InvalidInput with the nearest.
std::string key_of_axis(std::string_view axis, const std::string& origin);

}  // namespace experiments
