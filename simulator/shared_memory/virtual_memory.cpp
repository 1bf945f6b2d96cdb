#include "simulator/shared_memory/virtual_memory.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "simulator/shared_memory/item_manager.hpp"

namespace shared_memory {

namespace {

void check_range(const char* key, int found, int low, int high) {
  if (found < low || found > high)
    throw base::BadInput(fmt::format("{}: found {}, expected {} to {}", key, found, low, high));
}

void allocate(machine::Processor& processor, const std::string& key, std::uint64_t bytes) {
  auto& memory = processor.memory();
  if (const auto left = memory.left(); bytes > left)
    throw base::BadInput(
        fmt::format("{}: found {} bytes, expected at most the {} that are left of the memory of {}",
                    key, bytes, left, processor.name()));
  memory.allocate(bytes, key, {});
}

std::vector<std::uint64_t> sizes(const Catalogue& catalogue) {
  std::vector<std::uint64_t> bytes;
  for (std::size_t place = 0; place < catalogue.size(); ++place)
    bytes.push_back(catalogue.bytes(catalogue.item(place)));
  return bytes;
}

}  // namespace

std::uint64_t longest_message(const machine::Model& model, const Catalogue& catalogue,
                              const DataParams& params) {
  const auto items = params.scheme == Scheme::pages ? params.page_items : 1;
  return std::max(
      get_bytes(model, "data_request"),
      get_bytes(model, "data_reply") + static_cast<std::uint64_t>(items) * catalogue.largest());
}

VirtualMemory::VirtualMemory(machine::Machine& machine, network::Network& network,
                             const Catalogue& catalogue, const DataParams& params, int first) {
  const auto& routing = network.routing();
  const DataCosts costs(machine.model());
  const int n = routing.processors();
  check_range("data.coordinator", params.coordinator, 0, n - 1);
  check_range("data.page_items", params.page_items, 1, 1'000'000);
  for (int id = 0; id < n; ++id) {
    auto& processor = *machine.processors().at(static_cast<std::size_t>(first + id));
    auto& client = network.client(id);
    const bool serves = params.scheme == Scheme::items && id == params.coordinator;
    const std::string key = serves ? "server_cache_percent" : "cache_percent";
    const auto bytes = serves ? params.server_cache_bytes : params.cache_bytes;
    if (params.scheme == Scheme::pages) {
      const Pages pages(catalogue, params.page_items, n);
      LruCache cache(std::vector(pages.count, pages.bytes), bytes, key);
      allocate(processor, key, bytes);
      allocate(processor, "data.resident", pages.resident_bytes(id));
      managers_.push_back(
          std::make_unique<PageManager>(client, routing, costs, pages, std::move(cache)));
      continue;
    }
    LruCache cache(sizes(catalogue), bytes, key);
    allocate(processor, key, bytes);
    if (serves)
      managers_.push_back(std::make_unique<ItemServer>(client, routing, costs, catalogue,
                                                       std::move(cache), machine.model()));
    else
      managers_.push_back(std::make_unique<ItemManager>(
          client, routing, costs, catalogue, std::move(cache),
          ItemManager::Choices{params.coordinator, params.in_path, params.waiting_queue}));
  }
}

DataUse VirtualMemory::use() const {
  DataUse sum;
  for (const auto& manager : managers_) sum += manager->use();
  return sum;
}

}  // namespace shared_memory
