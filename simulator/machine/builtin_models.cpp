#include <fmt/format.h>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "base/text.hpp"
#include "simulator/machine/builtin_models.hpp"
#include "simulator/machine/model.hpp"

namespace machine {

std::vector<std::string> builtin_models() {
  std::vector<std::string> names;
  for (const auto& [name, text] : BUILTIN_MODELS) names.emplace_back(name);
  return names;
}

std::string describe_builtin(std::string_view name) {
  for (const auto& [known, text] : BUILTIN_MODELS)
    if (known == name) return base::first_comment(text);
  throw base::BadInput(
      fmt::format("unknown model \"{}\"{}", name, base::suggest(name, builtin_models())));
}

}  // namespace machine
