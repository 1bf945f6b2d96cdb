#pragma once
// One point of an experiment whose program is a pattern.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/observe/watch.hpp"

namespace laboratory {

// Runs the pattern and returns
//   "topology", "processors": the network, where the pattern uses one;
//   "row": name -> number, the columns of results.csv after axes and parameters, in order; null
//          for what is no finite number; of a pattern with parts instead
//   "rows": an array of such rows, the parts in each;
//   "notes": sentences about the run, where there are any;
//   "images": those it has made, see save_images; their files are in the folder `images`;
//   "ended": done, saturated (queues grow without bound), limit or interrupt: then there is an
//            empty "row";
//   "host": what the run cost the host, in seconds of CPU time: never part of a result.
// `watch`: its limit, and what is traced.
nlohmann::ordered_json run_pattern_point(const Experiment& experiment,
                                         const std::filesystem::path& images,
                                         observe::Watch& watch);

// Throws for files that are not there, and what the pattern's check throws.
void check_pattern_point(const Experiment& experiment);

}  // namespace laboratory
