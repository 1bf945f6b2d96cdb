#include "simulator/shared_memory/data_manager.hpp"

#include <cmath>
#include <numeric>

#include "simulator/observe/mean.hpp"
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

std::optional<double> share(double part, std::uint64_t all) {
  return observe::eval_mean(part, static_cast<double>(all));
}

base::Column<DataUse> level_column(const std::string& name, Level level, const std::string& where) {
  return base::column<DataUse>(
      name,
      [level](const DataUse& use) {
        return share(static_cast<double>(use.found_at(level)), use.accesses());
      },
      "share of the accesses that found their item " + where);
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

base::Columns<DataUse> data_columns() {
  return {
      base::column<DataUse>("accesses_made", &DataUse::accesses, "accesses to items"),
      level_column("local", Level::local, "in the processor's own memory"),
      level_column("on_path", Level::path,
                   "in the cache of a processor on the path to the coordinator; with pages, at the "
                   "owner of the page"),
      level_column("by_queue", Level::queue,
                   "in the reply to an earlier request of another processor (WRQu)"),
      level_column("at_coordinator", Level::coordinator, "in the coordinator's cache"),
      level_column("on_disk", Level::disk, "on the disk"),
      base::column("requests", &DataUse::requests, "requests sent to other processors"),
      base::column<DataUse>(
          "links_per_request",
          [](const DataUse& use) {
            return share(static_cast<double>(use.request_links), use.requests);
          },
          "mean number of links from a requesting processor to the answering one"),
      base::column("spared_by_path", &DataUse::spared_by_path,
                   "links that requests saved because caches on their path answered"),
      base::column("spared_by_queue", &DataUse::spared_by_queue,
                   "links that requests saved because of queues on their path (WRQu)"),
      base::column<DataUse>(
          "wait_per_request_s",
          [](const DataUse& use) { return share(use.waited.value, use.requests); },
          "mean time from a request to its reply"),
  };
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
    throw machine::Fault(
        this_process().name(), this_process().own_time(),
        fmt::format("a request for data of {} was returned: {}", this_process().processor().name(),
                    to_string(message.returned)));
  occam::case_of(
      network::read<DataMessage>(message),
      [&](const DataRequest& request) {
        ++use_.seen;
        handle_request(message, request);
      },
      [&](const DataReply& reply) {
        handle_reply(reply);
        has_reply_ = true;
      });
}

// The process of figure 5.20 of the thesis, without waiting.acknowledge, which is in fetch().
void DataManager::look() {
  network::Handed handed;
  for (bool serving = true; serving;)
    pri_alt(when(client_.from_router(), handed, [&] { take(std::move(handed.message)); }),
            occam::otherwise(true, [&] { serving = false; }));
}

// Waits for a message. With `period` > 0, models a process that polls once per period, and returns
// at the first poll after the arrival. Polls that find nothing need not be simulated.
void DataManager::wait_for_message(Seconds period) {
  const Seconds since = this_process().now();
  const occam::Guard guards[] = {occam::Guard(&client_.from_router())};
  occam::select(guards);
  if (period.value <= 0) return;
  const double periods = std::ceil((this_process().now() - since) / period);
  occam::wait_until(occam::ticks(since + periods * period));
}

std::optional<Message> DataManager::take_other() {
  look();
  if (others_.empty()) return std::nullopt;
  Message message = std::move(others_.front());
  others_.pop_front();
  return message;
}

Message DataManager::serve_every(Seconds period) {
  auto message = take_other();
  for (; !message; message = take_other()) wait_for_message(period);
  return *std::move(message);
}

std::optional<Message> DataManager::serve_until(std::int64_t tick) {
  auto message = take_other();
  for (bool is_early = true; !message && is_early; message = take_other()) {
    const occam::Guard guards[] = {occam::Guard(&client_.from_router()),
                                   occam::Guard::at(tick, true)};
    is_early = occam::select(guards) == 0;
  }
  return message;
}

void DataManager::serve_for_ever() {
  this_process().set_server();
  for (;;) serve();
}

void DataManager::send(network::Address to, std::uint64_t bytes, DataMessage content) {
  client_.send(network::make_message(DATA_PROCESS, to, bytes, content));
}

void DataManager::fetch(std::size_t record, network::Address to) {
  ++use_.requests;
  const Seconds since = this_process().now();
  has_reply_ = false;
  send(to, costs_.request_bytes, DataRequest{record});
  while (!has_reply_) take(client_.receive());
  use_.waited += this_process().now() - since;
}

void DataManager::reply(network::Address to, std::size_t record, std::uint64_t bytes, Level level,
                        int links) {
  send(to, costs_.reply_bytes + bytes, DataReply{record, level, links});
}

bool DataManager::touch(std::size_t record) {
  if (!cache_.holds(record)) return false;
  this_process().charge(costs_.touch);
  cache_.touch(record);
  return true;
}

void DataManager::insert(std::size_t record) {
  const int dropped = cache_.insert(record);
  this_process().charge(costs_.insert + dropped * costs_.drop);
}

}  // namespace shared_memory
