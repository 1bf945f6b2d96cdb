#include "experiments/laboratory/host/interrupt.hpp"

namespace laboratory {
namespace {

volatile std::sig_atomic_t interrupts = 0;

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupts = 0;
  for (std::size_t i = 0; i < std::size(ASKS_TO_END); ++i)
    old_[i] = std::signal(ASKS_TO_END[i], [](int) { interrupts = interrupts + 1; });
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < std::size(ASKS_TO_END); ++i) std::signal(ASKS_TO_END[i], old_[i]);
}

int count_interrupts() { return interrupts; }

}  // namespace laboratory
