#include "simulator/farm/centre.hpp"

namespace farm {

using namespace occam;

void RayDatabase::run(Channel<DatabaseRequest>& from_coord, Channel<DatabaseReply>& into_coord) {
  machine::Memory& memory = this_process().processor().memory();
  DatabaseRequest request;
  for (;;) {
    in(from_coord, request);
    DatabaseWork work;
    bool asked = true, any = false;
    if (std::holds_alternative<Stop>(request.content)) return;
    if (const auto* ray = std::get_if<renderer::Ray>(&request.content)) {
      memory.allocate(bytes.ray, "the ray database", this_process().now());
      stores.add(*ray, work);
      asked = false;
    } else if (const auto* limits = std::get_if<Limits>(&request.content)) {
      stores.set_limits(*limits, work);
      asked = false;
    } else {
      any = std::holds_alternative<AskAny>(request.content);
    }
    DatabaseReply reply;
    if (asked) reply.ray = stores.take(any, work);
    if (reply.ray) {
      reply.size = bytes.ray;
      memory.release(bytes.ray);
    }
    this_process().charge(cost(work.counts()));
    if (asked) out(into_coord, reply);
  }
}

}  // namespace farm
