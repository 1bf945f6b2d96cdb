// Progressive radiosity on a machine, as in AMP, with its picture.
#include "simulator/radiosity/program.hpp"

#include "base/errors.hpp"
#include "simulator/declare/routers.hpp"

namespace programs {

namespace {

amp::Params make_params(const Setup& setup) {
  static constexpr amp::Distribution DISTRIBUTIONS[] = {
      amp::Distribution::tiles, amp::Distribution::blocks, amp::Distribution::work};
  amp::Params params;
  params.solve = solve_params(setup);
  params.distribution = DISTRIBUTIONS[setup.whole("distribution")];
  params.exchange = setup.choice("borders") == "exchanged";
  params.method = method_of(setup);
  params.show_every = static_cast<int>(setup.whole("show_every"));
  params.cache_percent = setup["cache_percent"];
  params.cycles_per_host_s = setup.cycles_per_host_s;
  params.watch = setup.watch;
  return params;
}

Rows run(const Setup& setup) {
  auto room = load_meshed_room(setup);
  const auto result =
      amp::run_radiosity(setup.model, setup.topology, room.mesh, make_params(setup));
  if (result.end != machine::End::done)
    throw Unfinished(
        "machine", {result.total_s},
        fmt::format("the run was ended at {:.6f} s ({})", result.total_s, to_string(result.end)));
  Rows rows(make_radiosity_row(room.mesh, result, setup["cache_percent"] > 0));
  rows.notes = {describe_loss(result.loss, setup["cache_percent"] > 0)};
  add_pictures(setup, std::move(room), result.frames, rows);
  return rows;
}

void check(const Setup& setup) {
  check_rooms(setup);
  if (setup["peak_from"] >= setup["peak_to"])
    throw base::BadInput(fmt::format("program.peak_to: found {}, expected above peak_from, {}",
                                     setup["peak_to"], setup["peak_from"]));
}

std::vector<Parameter> parameters() {
  auto all = solution_parameters();
  const auto add = [&](const std::vector<Parameter>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  add({make_choice("distribution", {"tiles", "blocks", "work"},
                   "which processor has which patches: of every face an equal share; equal counts "
                   "of consecutive ones; consecutive ones of equal estimated work"),
       make_choice("borders", {"exchanged", "repeated"},
                   "vertices between processors: found by one, who tells the others, or by each"),
       method_parameter(),
       {"show_every", 0, 0, 1e9, true, "shots between two pictures on the way; 0: none"},
       {"cache_percent", 0, 0, 100, false,
        "of the geometry, that a processor's data manager has room for; 0: all have all of it"},
       make_choice("reconstruction", {"bilinear", "bicubic", "flat"},
                   "how illumination is interpolated")});
  add(view_parameters());
  add(reference_parameters());
  add({{"amplify", 1, 0, 1e6, false, "factor of the difference image"},
       {"peak_from", 0, 0, 1, false, "of the width: where the line's largest value is looked for"},
       {"peak_to", 1, 0, 1, false, "see peak_from"}});
  return all;
}

}  // namespace

Pattern make_radiosity() {
  return {.name = "radiosity",
          .help =
              "progressive radiosity as in AMP: the brightest patch is found by a reduction, sent "
              "to all, and received where the patches are; pictures of it. time_s until the last "
              "shot is done everywhere, total_s until the display has it. Of the time the shares "
              "useful, repeated (vertices found twice), unequal (waiting for who has most to do) "
              "and messages. With a reference: image_error, and of the central line line_error, "
              "peak_error and peak_shift (pixels)",
          .uses_topology = true,
          .parameters = parameters(),
          .run = &run,
          .uses_cost = true,
          .check = &check};
}

}  // namespace programs
