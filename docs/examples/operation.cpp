// An operation that costs cycles. A kernel counts its operations, the model says what each of them
// costs, and a process is charged the sum.
#include <fmt/format.h>

#include <array>
#include <fstream>
#include <iterator>

#include "simulator/machine/machine.hpp"

namespace {

// The operations that the kernel counts, and their names in section [operation] of a model file.
enum Op { texel_read, colour_mixed, OP_COUNT };
constexpr std::array<std::string_view, OP_COUNT> NAMES = {"texel_read", "colour_mixed"};
using Work = std::array<std::uint64_t, OP_COUNT>;

// The lines to add to simulator/machine/models/t805-25.toml. The cost of an operation is a sum of
// instructions or of other operations, and its source is stated.
constexpr const char* ENTRIES = R"([operation]
texel_read = { value = "2 * instruction.integer_mul + 3 * instruction.load", unit = "cycles", provenance = "assumed", source = "a row's and a column's address, three colours" }
colour_mixed = { value = "3 * instruction.mul + 3 * instruction.add", unit = "cycles", provenance = "assumed", source = "three products added to three sums" }
)";

// A kernel is ordinary C++ without knowledge of the machine. It counts its work while it computes
// the result.
double sample_bilinear(Work& work) {
  double sum = 0;
  for (int corner = 0; corner < 4; ++corner) {
    ++work[texel_read];
    ++work[colour_mixed];
    sum += 0.25 * corner;
  }
  return sum;
}

machine::Model load_extended_model() {
  std::ifstream in("simulator/machine/models/t805-25.toml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  text.replace(text.find("[operation]\n"), std::string_view("[operation]\n").size(), ENTRIES);
  return machine::parse_model(text, "t805-25.toml with textures");
}

}  // namespace

int main() {
  const auto model = load_extended_model();
  const machine::OperationCosts cycles_of(model, "intersection", NAMES);
  machine::Machine machine(model);
  auto& cpu = machine.add_processor("cpu", 1 << 20);
  cpu.start("sampler", machine::Priority::low, [&] {
    Work work{};
    sample_bilinear(work);
    machine::this_process().charge(cycles_of(work));
    fmt::print("{} texels, {} colours: {} cycles\n", work[texel_read], work[colour_mixed],
               cycles_of(work).value);
  });
  machine.run();
  fmt::print("done after {:.3f} us\n", 1e6 * machine.now().value);
}
