#pragma once
// The statements of NFF that scenes and rooms read alike, each after its first word; nff.hpp says
// what they hold. Errors are the tokens'.

#include <vector>

#include "base/errors.hpp"
#include "renderer/files/tokens.hpp"
#include "renderer/scene/scene.hpp"

namespace renderer {

/// `v`
View take_view(Tokens& tokens);
/// `f`
Surface take_surface(Tokens& tokens);

struct Outline {
  std::vector<Vec> corners, normals;  ///< as many of each, or no normals
};
/// `p`, or `pp` with normals; not yet known to be flat.
Outline take_outline(Tokens& tokens, bool with_normals);

/// Whatever `action` finds wrong with a scene is wrong at `line`.
template <typename Action>
void at_line(const Tokens& tokens, int line, const Action& action) {
  try {
    action();
  } catch (const base::BadInput& bad) {
    tokens.fail(line, bad.what());
  }
}

}  // namespace renderer
