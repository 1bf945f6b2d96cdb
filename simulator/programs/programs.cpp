#include "simulator/programs/programs.hpp"

#include "simulator/farm/program.hpp"
#include "simulator/iirra/program.hpp"
#include "simulator/parallel_radiosity/program.hpp"

namespace programs {

// Each of these functions is in the source file with the name of its program.
Program make_message();
Program make_soft();
Program make_both_ways();
Program make_unicast();
Program make_pipeline();
Program make_sources();
Program make_broadcast();
Program make_request();
Program make_alternative();
Program make_interrupt();
Program make_traffic();
Program make_task_farm();
Program make_law();
Program make_commstime();
Program make_flops();
Program make_metrics();
Program make_census();
Program make_deadlock();
Program make_global();
Program make_random_traffic();
Program make_router_load();
Program make_soak();
Program make_in_path();
Program make_data();
Program make_progressive();
Program make_noise();
Program make_refinement();
Program make_quadrants();

const std::vector<Program>& all_programs() {
  static const std::vector<Program> all = {
      farm::make_farm(),
      iirra::make_iirra(),
      make_message(),
      make_soft(),
      make_both_ways(),
      make_unicast(),
      make_pipeline(),
      make_sources(),
      make_broadcast(),
      make_request(),
      make_alternative(),
      make_interrupt(),
      make_traffic(),
      make_task_farm(),
      make_law(),
      make_commstime(),
      make_flops(),
      make_metrics(),
      make_census(),
      make_deadlock(),
      make_global(),
      make_random_traffic(),
      make_router_load(),
      make_soak(),
      make_in_path(),
      make_data(),
      make_progressive(),
      make_noise(),
      make_refinement(),
      make_quadrants(),
      parallel_radiosity::make_radiosity(),
      parallel_radiosity::make_scan_line(),
  };
  return all;
}

const Program* find_program(std::string_view name) {
  const auto found = std::ranges::find(all_programs(), name, &Program::name);
  return found == all_programs().end() ? nullptr : &*found;
}

}  // namespace programs
