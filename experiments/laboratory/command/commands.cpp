#include "experiments/laboratory/command/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "base/text.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/version.hpp"

namespace laboratory {

namespace {

void check_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> known;
  for (const auto* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (std::ranges::find(known, argv[1]) != known.end()) return;
  throw std::invalid_argument(
      fmt::format("unknown command \"{}\", expected one of {} (did you mean "
                  "\"{}\"?)",
                  argv[1], fmt::join(known, ", "), base::nearest_name(argv[1], known)));
}

}  // namespace

int run_tlab(int argc, char** argv) {
  CLI::App app("tlab, the transputer laboratory: simulates transputer machines that ray trace");
  app.set_version_flag("--version", fmt::format("tlab {}", VERSION));
  app.require_subcommand(1);
  add_topology_command(app);
  add_render_command(app);
  add_radiosity_command(app);
  add_run_command(app);
  add_merge_command(app);
  add_report_command(app);
  add_verify_command(app);
  add_model_command(app);
  add_columns_command(app);
  try {
    check_command(app, argc, argv);
    app.parse(argc, argv);
    if (std::fflush(stdout) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot write standard output");
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "tlab: the host is out of memory\n");
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "tlab: {}\n", error.what());
    return exit_code_of(error);
  }
}

}  // namespace laboratory
