#pragma once
// Declaration shared by the ray tracing programs. M is the type of a program's own parameters.
#include "simulator/programs/declare/support.hpp"
#include "simulator/ray_tracing/busy.hpp"
#include "simulator/ray_tracing/data.hpp"
#include "simulator/ray_tracing/pixel_order.hpp"
#include "simulator/ray_tracing/rendering.hpp"
#include "simulator/ray_tracing/session.hpp"
#include "simulator/ray_tracing/snapshot_fields.hpp"

namespace ray_tracing {

template <class M>
struct ProgramParams {
  M machine;  ///< sections [image], [[stage]], [[order]], and the program's own section
  std::optional<SharedParams> data;  ///< only if the experiment contains a key of [data]
  SceneChoice scene;

  bool shares_data() const { return data && data->cache_percent > 0; }
};

/// The field "weights", a list of numbers. They are stored in the members `of` of a struct W, which
/// is the member `member` of P.
template <class P, class W, std::size_t N, class Member>
base::Field<P> weights_field(double W::*const (&of)[N], Member member, const std::string& expected,
                             const std::string& help) {
  const auto set = [of = std::to_array(of), member](P& p, const base::Scalar& value) {
    const auto& given = std::get<std::vector<double>>(value);
    const auto is_weight = [](double w) { return w >= 0 && w <= 1e6; };
    if (given.size() != N || !std::ranges::all_of(given, is_weight)) return false;
    W weights;
    for (std::size_t i = 0; i < N; ++i) weights.*of[i] = given[i];
    p.*member = weights;
    return true;
  };
  const auto get = [of = std::to_array(of), member](const P& p) -> base::Scalar {
    const std::optional<W> weights = p.*member;
    if (!weights) return {};
    std::vector<double> all;
    for (const auto weight : of) all.push_back((*weights).*weight);
    return all;
  };
  return base::Declare<P>::custom(
      "weights", {.kind = base::Domain::Kind::list, .expected = expected}, "", help, set, get);
}

/// The fields for limits on the influence factor and the tree level of rays.
template <class Limits>
base::Fields<Limits> ray_limit_fields() {
  using D = base::Declare<Limits>;
  return {D::number("min_influence", &Limits::min_influence, 0, 1, "",
                    "smallest influence factor of a ray"),
          D::whole("depth_reflected", &Limits::depth_reflected, 0, 1000, "",
                   "deepest tree level of rays whose ancestors were only reflected"),
          D::whole("depth_transmitted", &Limits::depth_transmitted, 0, 1000, "",
                   "deepest tree level of transmitted rays and their descendants")};
}

/// All fields of a program. `memory` has the fields of the section [machine], and `own` has the
/// fields of the section with the program's name.
template <class M>
base::Fields<ProgramParams<M>> program_fields(const std::string& program,
                                              const base::Fields<M>& memory,
                                              const base::Fields<M>& own) {
  using P = ProgramParams<M>;
  const auto image = [](auto& p) -> auto& { return p.machine.image; };
  const auto snapshot_times = [](auto& p) -> auto& { return p.machine.snapshot_times; };
  return base::join(
      base::lift_all<P>(memory, &P::machine, "machine."),
      {base::lift_all<P>(scene_fields(), &P::scene),
       base::lift_all<P>(renderer::param_fields(), image, "image."),
       base::lift_all<P>(own, &P::machine, program + "."),
       base::lift_all<P>(snapshot_fields(), snapshot_times, program + "."),
       // This field is the last one, so that the key "order" without a section means the program's
       // own order, not image.order.
       base::lift_all<P>(base::Fields<M>{pixel_order_field(&M::pixels)}, &P::machine, "image."),
       base::lift_optional<P>(data_fields(), &P::data)});
}

/// Measurements of a run. R is derived from Rendering, and the program defines find_loads(R).
template <class R>
struct Measured {
  Measured(R result, DataFigures figures)
      : run(std::move(result)),
        data(std::move(figures)),
        busy(make_busy(run.use)),
        loads(find_loads(run)) {}

  R run;
  DataFigures data;
  Busy busy;
  snapshots::Figures growth = {};
  Loads loads;
};

/// Makes the outcome of a run. R is derived from Measured.
template <class M, class R>
programs::Outcome<R> make_outcome(const programs::Setup& setup, const ProgramParams<M>& params,
                                  R measured) {
  const auto& machine = params.machine;
  auto given = make_given(setup, params.scene, machine.image, machine.max_cell, measured.run);
  measured.growth = given.growth;
  programs::Outcome<R> outcome;
  static_cast<programs::Extras&>(outcome) = std::move(given.extras);
  outcome.loads = measured.loads;
  outcome.rows.push_back(std::move(measured));
  return outcome;
}

/// Makes a program, and adds the declarations that all ray tracing programs share.
template <class Limits, class M, class R>
programs::Program make_program(programs::Declaration<ProgramParams<M>, R> d,
                               const base::Fields<Limits>& limits) {
  using P = ProgramParams<M>;
  d.describe = [](const P& params) { return describe(params.scene); };
  d.lists = make_lists<P>(
      limits, [](auto& p) -> auto& { return p.machine.stages; },
      [](auto& p) -> auto& { return p.machine.script; });
  d.picture_key = [](const P& params) { return picture_key(params.scene, params.machine.image); };
  d.voids = [](const P& params, const std::string& key) { return find_void(params.scene, key); };
  d.shows.leading = {"topology", "workers", "objects"};
  auto program = programs::make_program(d);
  program.processors = "workers";
  program.shows_picture = true;
  program.shows_parameters = false;
  return program;
}

}  // namespace ray_tracing
