#include "simulator/shared_memory/data_manager.hpp"

#include <cmath>
#include <numeric>

#include "simulator/occam/alt.hpp"
#include "simulator/occam/case_of.hpp"
#include "simulator/occam/process.hpp"

namespace shared_memory {

using network::Message;
using occam::this_process;

std::uint64_t DataUse::accesses() const {
  return std::accumulate(found.begin(), found.end(), std::uint64_t{0});
}

namespace {

template <class Change>
void change(DataUse& use, const DataUse& by, Change apply) {
  for (std::size_t i = 0; i < LEVELS; ++i) apply(use.found[i], by.found[i]);
  for (const auto counter : {&DataUse::requests, &DataUse::request_links, &DataUse::spared_by_path,
                             &DataUse::spared_by_queue, &DataUse::seen, &DataUse::answered,
                             &DataUse::queued, &DataUse::passed_on})
    apply(use.*counter, by.*counter);
  apply(use.waited, by.waited);
}

}  // namespace

DataUse& DataUse::operator+=(const DataUse& other) {
  change(*this, other, [](auto& a, const auto& b) { a += b; });
  return *this;
}

DataUse& DataUse::operator-=(const DataUse& earlier) {
  change(*this, earlier, [](auto& a, const auto& b) { a -= b; });
  return *this;
}

DataCosts::DataCosts(const machine::Model& model)
    : look_up(get_operation(model, "data_looked_up")),
      touch(get_operation(model, "data_touched")),
      insert(get_operation(model, "data_inserted")),
      drop(get_operation(model, "data_dropped")),
      request_bytes(get_bytes(model, "data_request")),
      reply_bytes(get_bytes(model, "data_reply")),
      idle_period{model.software.idle_period} {}

void DataManager::take(Message message) {
  if (message.to.process != DATA_PROCESS) return others_.push_back(std::move(message));
  if (message.returned != network::Returned::no)
    throw machine::Fault(this_process().name(), this_process().now(),
                         fmt::format("a request for data of processor {} came back: {}",
                                     client_.processor(), to_string(message.returned)));
  occam::case_of(
      static_cast<const DataMessage&>(*message.contents),
      [&](const DataRequest& request) {
        ++use_.seen;
        handle_request(message, request);
      },
      [&](const DataReply& reply) {
        handle_reply(reply);
        has_reply_ = true;
      });
}

// Figure 5.20, without waiting.acknowledge: see fetch().
void DataManager::look() {
  network::Handed handed;
  for (bool serving = true; serving;)
    pri_alt(when(client_.from_router(), handed, [&] { take(std::move(handed.message)); }),
            occam::otherwise(true, [&] { serving = false; }));
}

// An idle process looks every period: it finds what is there by then. (Looks that find nothing are
// not simulated.)
void DataManager::wait_for_message(Seconds period) {
  const Seconds since = this_process().now();
  const occam::Guard guards[] = {occam::Guard(&client_.from_router())};
  occam::select(guards);
  if (period.value <= 0) return;
  const double periods = std::ceil((this_process().now() - since) / period);
  occam::wait_until(occam::ticks(since + periods * period));
}

Message DataManager::serve_every(Seconds period) {
  for (look(); others_.empty(); look()) wait_for_message(period);
  Message message = std::move(others_.front());
  others_.pop_front();
  return message;
}

void DataManager::serve_for_ever() {
  this_process().set_server();
  for (;;) serve();
}

void DataManager::send(network::Address to, std::uint64_t bytes, const DataMessage& contents) {
  Message message;
  message.to = to;
  message.from.process = DATA_PROCESS;
  message.length = bytes;
  message.contents = std::make_shared<const DataMessage>(contents);
  client_.send(std::move(message));
}

void DataManager::fetch(std::size_t record, network::Address to) {
  ++use_.requests;
  const Seconds since = this_process().now();
  has_reply_ = false;
  send(to, costs_.request_bytes, DataMessage(DataRequest{record}));
  while (!has_reply_) take(client_.receive());
  use_.waited += this_process().now() - since;
}

void DataManager::reply(network::Address to, std::size_t record, std::uint64_t bytes, Level level,
                        int links) {
  send(to, costs_.reply_bytes + bytes, DataMessage(DataReply{record, level, links}));
}

void DataManager::charge_insertion(int dropped) {
  this_process().charge(costs_.insert + dropped * costs_.drop);
}

}  // namespace shared_memory
