#include <memory>

#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/command/run.hpp"
#include "experiments/laboratory/report/run_report.hpp"

namespace laboratory {

namespace {

void add_folder_command(CLI::App& app, const char* name, const char* help,
                        void (*action)(const std::string&)) {
  auto* command = app.add_subcommand(name, help);
  auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "a results folder")->required();
  command->callback([folder, action] { action(*folder); });
}

}  // namespace

void add_merge_command(CLI::App& app) {
  add_folder_command(app, "merge", "write the results of points that `run --point` has recorded",
                     &merge_results);
}

void add_report_command(CLI::App& app) {
  add_folder_command(app, "report", "make plots and report.html of results again", &report_results);
}

}  // namespace laboratory
