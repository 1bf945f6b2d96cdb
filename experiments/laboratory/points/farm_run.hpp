#pragma once
// One point of a farm experiment: run it, and reduce what happened to a row of numbers.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/laboratory/file/experiment.hpp"
#include "topologies/graph/topology.hpp"

namespace laboratory {

// The workers' topology of an experiment: "tree" and 7 workers is tree:7, "mesh" and 12 is the most
// square mesh of 12. Throws base::BadInput or base::BadInput.
topologies::Topology make_workers(const Experiment& experiment);
// Whether the topology or the scene says its size itself, so that `workers` or `objects` is void.
bool has_own_workers(const Experiment& experiment);
bool has_own_objects(const Experiment& experiment);
// "spheres" and 200 objects is spheres:200.
std::string scene_source(const Experiment& experiment);

// "topology": its name; "workers", "objects": how many there are.
nlohmann::ordered_json describe_farm(const Experiment& experiment);

// Runs the farm, puts its images into the folder `images`, each in a file named by its content, and
// returns what describe_farm does, and
//   "row": name -> number or text, the columns of results.csv after the axes, in order;
//   "ended": done, limit or interrupt: then the row is what was measured until then;
//   "image": the name of its file, the same for equal images only;
//   "key_images": of each stage but the last "file" and "at_s";
//   "use": how busy processors and links were;
//   "host": what the run cost the host, in seconds of CPU time: never part of a result.
// `watch`: its limit, and what is traced.
nlohmann::ordered_json run_farm_point(const Experiment& experiment,
                                      const std::filesystem::path& images, bool profile,
                                      observe::Watch& watch);

}  // namespace laboratory
