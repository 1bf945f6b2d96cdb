#include "experiments/pattern_run.hpp"

#include <cmath>
#include <ctime>

#include "experiments/farm_run.hpp"
#include "experiments/machine_model.hpp"
#include "experiments/program.hpp"
#include "topologies/generators.hpp"

namespace experiments {

using nlohmann::ordered_json;

ordered_json run_pattern_point(const Experiment& experiment, observe::Watch& watch) {
  const auto start = std::clock();
  const auto& pattern = *find_pattern(experiment.program);
  const auto model = make_model(experiment);
  const patterns::Setup setup{
      model, pattern.uses_topology ? make_workers(experiment) : topologies::make_line(1),
      experiment.parameters, &watch};
  ordered_json result = ordered_json::object(), row = ordered_json::object();
  if (pattern.uses_topology) {
    result["topology"] = setup.topology.name;
    result["processors"] = setup.topology.processors;
  }
  std::string ended = "done";
  try {
    for (const auto& [name, value] : pattern.run(setup)) {
      row[name] = std::isfinite(value) ? ordered_json(value) : ordered_json();
      if (name == "saturated" && value != 0) ended = "saturated";
    }
  } catch (const patterns::Unfinished&) {
    ended = machine::to_string(watch.end);
    row = ordered_json::object();
  }
  result["ended"] = ended;
  result["row"] = std::move(row);
  result["host"] = {{"total_s", static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC}};
  return result;
}

}  // namespace experiments
