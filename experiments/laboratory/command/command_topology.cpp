#include <fmt/format.h>

#include "base/whole_file.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "topologies/draw/graphviz.hpp"
#include "topologies/files/formats.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {

namespace {

struct Options {
  std::string spec, format = "metrics", output;
};

std::string to_format(const topologies::Topology& topology, const std::string& format) {
  if (format == "dot") return topologies::to_dot(topology);
  if (format == "graphml") return topologies::to_graphml(topology);
  if (format == "csv") return topologies::to_csv(topology);
  if (format == "svg") return topologies::to_svg(topology);
  return topologies::to_metrics(topology);
}

}  // namespace

void add_topology_command(CLI::App& app) {
  auto* command = app.add_subcommand("topology", "print the metrics of a topology, or export it");
  auto o = std::make_shared<Options>();
  std::string forms;
  for (const auto& g : topologies::generators()) forms += g.form + ", ";
  command->add_option("SPEC", o->spec, forms + "or a .dot, .gv or .graphml file")->required();
  command->add_option("--format", o->format, "what to print")
      ->check(CLI::IsMember({"metrics", "dot", "graphml", "svg", "csv"}))
      ->capture_default_str();
  command->add_option("-o,--output", o->output, "write to this file");
  command->callback([o] {
    const auto text = to_format(topologies::make_topology(o->spec), o->format);
    if (o->output.empty())
      fmt::print("{}", text);
    else
      base::save_whole(o->output, text);
  });
}

}  // namespace laboratory
