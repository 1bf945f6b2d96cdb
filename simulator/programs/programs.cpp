#include "simulator/programs/programs.hpp"

#include <iterator>
#include <set>

#include "base/errors.hpp"
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

namespace {

std::vector<Program>& list() {
  static std::vector<Program> all = {
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

void check_declaration(const Program& program) {
  constexpr std::string_view CHARACTERS = "abcdefghijklmnopqrstuvwxyz0123456789_";
  base::require(
      !program.name.empty() && program.name.find_first_not_of(CHARACTERS) == std::string::npos,
      "programs", "found the name \"{}\", expected small letters, digits and _", program.name);
  const auto place = "program " + program.name;
  base::require(static_cast<bool>(program.run), place, "found no function run, expected one");
  std::set<std::string> names{"topology", "workers", "processors"};  // of [network]
  const auto add = [&](const char* what, const std::string& name) {
    base::require(!name.empty() && names.insert(name).second, place,
                  "found the {} \"{}\", expected a name that no other parameter or column has",
                  what, name);
  };
  for (const auto& p : program.parameters) {
    add("parameter", p.name);
    const auto value = p.get(program.defaults);
    base::require(p.domain.is_required || std::holds_alternative<std::monostate>(value) ||
                      p.domain.allows(value),
                  place, "found {} as the default of {}, expected {}", base::to_text(value), p.name,
                  p.domain.describe());
  }
  names.erase("processors");  // a usual result
  for (const auto& column : program.columns) add("column", column.name);
}

}  // namespace

const std::vector<Program>& all_programs() { return list(); }

void add_programs(std::vector<Program> own) {
  std::set<std::string> names;
  for (const auto& program : list()) names.insert(program.name);
  for (const auto& program : own) {
    check_declaration(program);
    base::require(names.insert(program.name).second, "programs",
                  "found two programs of the name \"{}\", expected different names", program.name);
  }
  std::ranges::move(own, std::back_inserter(list()));
}

const Program* find_program(std::string_view name) {
  const auto found = std::ranges::find(all_programs(), name, &Program::name);
  return found == all_programs().end() ? nullptr : &*found;
}

}  // namespace programs
