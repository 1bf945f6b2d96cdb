#pragma once
// Patches send, elements receive: substructuring (M. Cohen, D. Greenberg, D. Immel and P. Brock,
// "An Efficient Radiosity Approach for Realistic Image Synthesis", IEEE CG&A 6(3), 1986).

#include "renderer/radiosity/light/solve.hpp"

namespace radiosity {

/// Solves on the mesh `coarse`, as solve does, and lets the vertices of `fine` receive every shot
/// too: the solution's vertices are those of `fine`. Both are meshes of the same room. A mesh of
/// 14,000 patches takes as many shots as the coarse one, not a hundred times as many.
Solution relight(const Mesh& coarse, const Mesh& fine, const SolveParams& params,
                 const std::function<bool(int shots, double unshot)>& step = nullptr);

}  // namespace radiosity
