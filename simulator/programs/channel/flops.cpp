// A sequence of floating-point additions, for comparison with the peak rate in data sheets.
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace flops {

struct Params {
  std::int64_t operations = 10000;
};

struct Measured {
  double mflops = 0;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  Machine machine(setup, 1);
  machine[0].start("additions", Priority::low, [&] {
    for (std::int64_t i = 0; i < params.operations; ++i)
      compute(get_instruction(setup.model, "add"));
  });
  run_machine(setup, machine);
  return Measured{static_cast<double>(params.operations) / machine.now().value / 1e6};
}

}  // namespace flops

Program make_flops() {
  using namespace flops;
  return make_program<Params, Measured>(
      {.name = "flops",
       .help = "additions of 32-bit reals with operands in registers",
       .fields = {base::Declare<Params>::whole("operations", &Params::operations, 1, 1e9, "",
                                               "additions")},
       .columns = {column("mflops", &Measured::mflops, "million additions a second")},
       .run = &run});
}

}  // namespace programs
