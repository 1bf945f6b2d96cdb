#include "experiments/commands.hpp"

#include <fmt/format.h>

#include "experiments/jobs.hpp"
#include "experiments/version.hpp"

namespace experiments {

int run_tlab(int argc, char** argv) {
  CLI::App app("tlab, the transputer laboratory: simulates transputer machines that ray trace");
  app.set_version_flag("--version", fmt::format("tlab {}", VERSION));
  app.require_subcommand(1);
  add_topology_command(app);
  add_render_command(app);
  add_run_command(app);
  add_model_command(app);
  try {
    app.parse(argc, argv);
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

}  // namespace experiments
