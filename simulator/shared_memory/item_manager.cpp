#include "simulator/shared_memory/item_manager.hpp"

#include "base/errors.hpp"
#include "simulator/occam/process.hpp"

namespace shared_memory {

using network::Message;
using network::Mode;
using occam::this_process;

// Figure 5.21.
void ItemManager::access(Item item) {
  look();
  const std::size_t record = catalogue_.place(item);
  this_process().charge(costs_.look_up);
  if (cache_.holds(record)) {
    this_process().charge(costs_.touch);
    cache_.touch(record);
    return count(Level::local);
  }
  asked_ = record;
  fetch(record,
        {choices_.coordinator, DATA_PROCESS, choices_.in_path ? Mode::in_path_to : Mode::unicast});
}

void ItemManager::handle_request(const Message& message, const DataRequest& request) {
  this_process().charge(costs_.look_up);
  if (cache_.holds(request.record)) {
    ++use_.answered;
    reply(message.from, request.record, catalogue_.bytes(catalogue_.item(request.record)),
          Level::path, message.links);
  } else if (choices_.waiting_queue && asked_ == request.record) {
    ++use_.queued;
    waiting_.push_back({message.from, message.links});
  } else {
    ++use_.passed_on;
    client().give_back(message);
  }
}

void ItemManager::handle_reply(const DataReply& reply) {
  base::check_equal("the record that came", asked_ == reply.record, true);
  const auto bytes = catalogue_.bytes(catalogue_.item(reply.record));
  for (const Waiting& waiting : std::exchange(waiting_, {}))
    this->reply(waiting.who, reply.record, bytes, Level::queue, waiting.links);
  charge_insertion(cache_.insert(reply.record));
  asked_.reset();
  const int far = routing_.distance(client().processor(), choices_.coordinator);
  use_.request_links += static_cast<std::uint64_t>(reply.links);
  const auto spared = static_cast<std::uint64_t>(far - reply.links);
  if (reply.level == Level::path) use_.spared_by_path += spared;
  if (reply.level == Level::queue) use_.spared_by_queue += spared;
  count(reply.level);
}

namespace {

struct DiskWait : machine::Wait {
  std::string describe() const override { return "the disk"; }
};

}  // namespace

void Disk::read(std::uint64_t bytes) {
  auto& self = this_process();
  self.sync();
  const Seconds time = seek_ + Seconds{static_cast<double>(bytes) / rate_};
  self.processor().wake_at(self.now() + time, self, self.waits() + 1);
  DiskWait wait;
  self.block(wait);
}

// Items that others do not ask for do not push out those that they do.
void ItemServer::access(Item item) {
  look();
  this_process().charge(costs_.look_up);
  if (cache_.holds(catalogue_.place(item))) return count(Level::local);
  disk_.read(catalogue_.bytes(item));
  count(Level::disk);
}

void ItemServer::handle_request(const Message& message, const DataRequest& request) {
  const auto bytes = catalogue_.bytes(catalogue_.item(request.record));
  const bool held = cache_.holds(request.record);
  this_process().charge(costs_.look_up);
  if (held) {
    this_process().charge(costs_.touch);
    cache_.touch(request.record);
  } else {
    disk_.read(bytes);
    charge_insertion(cache_.insert(request.record));
  }
  ++use_.answered;
  reply(message.from, request.record, bytes, held ? Level::coordinator : Level::disk,
        message.links);
}

void ItemServer::handle_reply(const DataReply& /*reply*/) {
  throw base::InvariantBroken("a reply for the coordinator, which asks nobody");
}

}  // namespace shared_memory
