#include "simulator/shared_memory/page_manager.hpp"

#include <algorithm>

#include "simulator/occam/process.hpp"

namespace shared_memory {

using occam::this_process;

Pages::Pages(const Catalogue& catalogue, int items_of_page, int processors)
    : catalogue(catalogue),
      items_of_page(static_cast<std::size_t>(items_of_page)),
      count((catalogue.size() + this->items_of_page - 1) / this->items_of_page),
      bytes(this->items_of_page * catalogue.largest()),
      processors(processors) {}

std::size_t Pages::page_of(Item item) const { return catalogue.place(item) / items_of_page; }

int Pages::owner(std::size_t page) const {
  return static_cast<int>(page * static_cast<std::size_t>(processors) / count);
}

std::uint64_t Pages::resident_bytes(int processor) const {
  std::uint64_t sum = 0;
  for (std::size_t page = 0; page < count; ++page)
    if (owner(page) == processor) sum += bytes;
  return sum;
}

// Figure 5.21, with pages.
void PageManager::access(Item item) {
  look();
  const std::size_t page = pages_.page_of(item);
  this_process().charge(costs_.look_up);
  const int owner = pages_.owner(page), here = client().processor();
  if (owner == here) return count(Level::local);
  if (cache_.holds(page)) {
    this_process().charge(costs_.touch);
    cache_.touch(page);
    return count(Level::local);
  }
  fetch(page, {owner, DATA_PROCESS, network::Mode::unicast});
}

void PageManager::handle_request(const network::Message& message, const DataRequest& request) {
  this_process().charge(costs_.look_up);
  ++use_.answered;
  reply(message.from, request.record, pages_.bytes, Level::path, message.links);
}

void PageManager::handle_reply(const DataReply& reply) {
  charge_insertion(cache_.insert(reply.record));
  use_.request_links += static_cast<std::uint64_t>(reply.links);
  count(Level::path);
}

}  // namespace shared_memory
