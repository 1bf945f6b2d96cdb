#include "simulator/shared_memory/cache_manager.hpp"

#include "simulator/occam/process.hpp"

namespace shared_memory {

using occam::this_process;

namespace {

// Maximum number of queued accesses; while the queue is full, the application waits.
constexpr std::size_t MOST_NOTED = 64;
constexpr std::uint64_t WORD = 4;  // bytes of a queued access

}  // namespace

void CacheManager::access(Item item) {
  look();
  const std::size_t record = record_of(item);
  this_process().charge(costs_.look_up);
  if (is_resident(record) || touch(record)) return count(Level::local);
  ask(record);
}

CompanionManager::CompanionManager(DataManagerMeans means, CacheManager& manager,
                                   machine::Processor& router, machine::Processor& own)
    : DataManager(std::move(means)),
      manager_(manager),
      queue_step_(get_compiled(router.model(), "fifo_step")),
      orders_(own.name() + ".orders", own, router),
      fetched_(own.name() + ".fetched", router, own) {
  router.memory().allocate(MOST_NOTED * WORD, "the queue of accesses", {});
  router.start(router.name() + ".data", machine::Priority::low, [this] { run_manager(); });
}

void CompanionManager::access(Item item) {
  auto& self = this_process();
  const std::size_t record = manager_.record_of(item);
  self.charge(costs_.look_up);
  self.sync();  // the cache must reflect all earlier actions of the manager
  if (!manager_.holds(record)) {
    out(orders_, Order{record});
    in(fetched_);
    return;
  }
  count(Level::local);
  if (manager_.is_resident(record)) return;
  self.charge(queue_step_);
  self.sync();
  while (noted_.size() == MOST_NOTED) out(orders_, Order{});  // waits for room in the queue
  noted_.push_back(record);
  if (is_asleep_) out(orders_, Order{});
}

void CompanionManager::run_manager() {
  this_process().set_server();
  network::Handed handed;
  Order order;
  for (;;) {
    is_asleep_ = noted_.empty();
    pri_alt(when(manager_.client().from_router(), handed,
                 [&] {
                   is_asleep_ = false;
                   manager_.serve_one(std::move(handed.message));
                 }),
            when(orders_, order,
                 [&] {
                   is_asleep_ = false;
                   obey(order);
                 }),
            occam::otherwise(!noted_.empty(), [&] { note_first(); }));
  }
}

// Executes an order of the application. Before a record is fetched, applies all queued accesses to
// the LRU list, so that the cache evicts the same records as on a single processor.
void CompanionManager::obey(Order order) {
  if (noted_.size() == MOST_NOTED) note_first();
  if (!order.record) return;
  while (!noted_.empty()) note_first();
  manager_.ask(*order.record);
  out(fetched_, occam::Signal{});
}

void CompanionManager::note_first() {
  manager_.note_access(noted_.front());
  this_process().charge(queue_step_);
  this_process().sync();
  noted_.pop_front();
}

void CompanionManager::handle_request(const network::Message& /*message*/,
                                      const DataRequest& /*request*/) {
  throw base::InvariantBroken(
      "a request for data at the client of an application, which serves none");
}

void CompanionManager::handle_reply(const DataReply& /*reply*/) {
  throw base::InvariantBroken(
      "a reply with data at the client of an application, which made no request");
}

}  // namespace shared_memory
