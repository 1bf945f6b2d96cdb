// Floating-point additions, one after the other: the peak rate of data sheets.
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

Row run(const Setup& setup) {
  const auto operations = setup.whole("operations");
  machine::Machine machine(setup.model);
  add_processors(machine, 1);
  machine.processors()[0]->start("additions", Priority::low, [&] {
    for (std::int64_t i = 0; i < operations; ++i) compute(get_instruction(setup.model, "add"));
    this_process().sync();
  });
  run_machine(setup, machine);
  return {{"mflops", static_cast<double>(operations) / machine.now().value / 1e6}};
}

}  // namespace

Pattern make_flops() {
  return {"flops",
          "additions of 32-bit reals, operands in registers: mflops",
          false,
          {{"operations", 10000, 1, 1e9, true, "additions"}},
          &run};
}

}  // namespace programs
