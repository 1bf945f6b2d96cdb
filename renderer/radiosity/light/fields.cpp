#include "renderer/radiosity/light/fields.hpp"

namespace radiosity {

base::Fields<MeshParams> mesh_fields() {
  return {base::Declare<MeshParams>::whole("refine", &MeshParams::refine, 1, 1000, "",
                                           "multiplies the divisions of every face of the room")};
}

base::Fields<FactorParams> factor_fields() {
  using D = base::Declare<FactorParams>;
  using F = FactorParams;
  return {
      D::whole("samples", &F::samples, 1, 1024, "",
               "a patch is cut into samples x samples delta areas, and more when near"),
      D::number("spread", &F::spread, 1e-6, 1e6, "",
                "a delta area is halved while it is wider than this share of its distance"),
      D::whole("halvings", &F::halvings, 0, 30, "", "times that a delta area is halved, at most"),
      D::whole("reflections", &F::reflections, 0, MOST_REFLECTIONS, "",
               "mirrors that light may meet on its way"),
      D::whole("mirror_pieces", &F::mirror_pieces, 0, 1000, "",
               "pieces that a mirror is cut into, along and across; 0: as each delta area "
               "needs"),
      D::number("mirror_share", &F::mirror_share, 1e-6, 1e9, "",
                "a delta area that is seen in mirrors is halved while it looks wider than this "
                "share of them")};
}

base::Fields<SolveParams> solve_fields() {
  using D = base::Declare<SolveParams>;
  static const base::Names<Mean> MEANS = {{"simpson", Mean::simpson}, {"corners", Mean::corners}};
  return base::join(
      base::lift_all<SolveParams>(factor_fields(), &SolveParams::factor),
      {{D::choice("mean", &SolveParams::mean, MEANS,
                  "what a patch has received: a twelfth of each corner's and two thirds of the "
                  "centre's; or the mean of its corners"),
        D::whole("max_shots", &SolveParams::shots, 0, 1e9, "",
                 "times that a patch sends its light, at most"),
        D::number("tolerance", &SolveParams::tolerance, 0, 1, "",
                  "share of the emitted power that may stay unsent")}});
}

}  // namespace radiosity
