#include "simulator/farm/centre.hpp"
#include "simulator/occam/process.hpp"

namespace farm {

using namespace occam;

void interaction(const std::vector<Order>& script, Channel<Command>& into_coordination) {
  for (const Order& order : script) {
    if (order.at.value > 0) wait_until(ticks(order.at));
    out(into_coordination, order.command);
  }
}

}  // namespace farm
