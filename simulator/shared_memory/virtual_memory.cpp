#include "simulator/shared_memory/virtual_memory.hpp"

#include "simulator/occam/process.hpp"

namespace shared_memory {

using network::Message;
using network::Mode;
using occam::this_process;

namespace {

// Data manager (DM) with a cache for the local application. Reads by other processors do not change
// the cache's LRU list.
class ItemManager : public CacheManager {
 public:
  ItemManager(DataManagerMeans means, const Catalogue& catalogue, const DataParams& params)
      : CacheManager(std::move(means)), catalogue_(catalogue), params_(params) {}

  std::size_t record_of(Item item) const override { return catalogue_.place(item); }
  void ask(std::size_t record) override {
    asked_ = record;
    fetch(record,
          {params_.coordinator, DATA_PROCESS, params_.in_path ? Mode::in_path_to : Mode::unicast});
  }

 private:
  struct Waiting {
    network::Address who;
    int links;
  };

  void handle_request(const Message& message, const DataRequest& request) override {
    this_process().charge(costs_.look_up);
    if (cache_.holds(request.record)) {
      ++use_.answered;
      reply(message.from, request.record, catalogue_.bytes().at(request.record), Level::path,
            message.links);
    } else if (params_.waiting_queue && asked_ == request.record) {
      ++use_.queued;
      waiting_.push_back({message.from, message.links});
    } else {
      ++use_.passed_on;
      client().give_back(message);
    }
  }

  void handle_reply(const DataReply& reply) override {
    base::check_equal("the received record", asked_ == reply.record, true);
    const auto bytes = catalogue_.bytes().at(reply.record);
    for (const Waiting& waiting : std::exchange(waiting_, {}))
      this->reply(waiting.who, reply.record, bytes, Level::queue, waiting.links);
    insert(reply.record);
    asked_.reset();
    const int far = routing_.distance(client().processor(), params_.coordinator);
    use_.request_links += static_cast<std::uint64_t>(reply.links);
    const auto spared = static_cast<std::uint64_t>(far - reply.links);
    if (reply.level == Level::path) use_.spared_by_path += spared;
    if (reply.level == Level::queue) use_.spared_by_queue += spared;
    count(reply.level);
  }

  const Catalogue& catalogue_;
  const DataParams params_;
  std::optional<std::size_t> asked_;
  // Queue WRQu: requests of other processors for the record `asked_`.
  std::vector<Waiting> waiting_;
};

struct DiskWait : machine::Wait {
  std::string describe() const override { return "the disk"; }
};

// Reads a record from the disk of the host computer, over the link to this computer. The process
// blocks until the record has arrived.
void read_disk(std::uint64_t bytes) {
  auto& self = this_process();
  const auto& disk = self.processor().model().disk;
  const Seconds time{disk.seek + static_cast<double>(bytes) / disk.rate};
  self.processor().wake_at(self.now() + time, self, self.waits() + 1);
  DiskWait wait;
  self.block(wait);
}

// Data manager of the coordinator (DMS). Its cache is for other processors; the local application
// can read it too. Missing records are read from the disk; during that time the manager serves no
// requests.
class ItemServer : public DataManager {
 public:
  ItemServer(DataManagerMeans means, const Catalogue& catalogue)
      : DataManager(std::move(means)), catalogue_(catalogue) {}

  // A local access does not insert a missing item into the cache. Items requested by other
  // processors are thus not evicted.
  void access(Item item) override {
    look();
    this_process().charge(costs_.look_up);
    const std::size_t record = catalogue_.place(item);
    if (cache_.holds(record)) return count(Level::local);
    read_disk(catalogue_.bytes().at(record));
    count(Level::disk);
  }

 private:
  void handle_request(const Message& message, const DataRequest& request) override {
    const auto bytes = catalogue_.bytes().at(request.record);
    this_process().charge(costs_.look_up);
    const bool held = touch(request.record);
    if (!held) {
      read_disk(bytes);
      insert(request.record);
    }
    ++use_.answered;
    reply(message.from, request.record, bytes, held ? Level::coordinator : Level::disk,
          message.links);
  }

  void handle_reply(const DataReply& /*reply*/) override {
    throw base::InvariantBroken("a reply to the coordinator, which makes no requests");
  }

  const Catalogue& catalogue_;
};

// Assigns pages to processors, in consecutive blocks of about equal length.
struct Pages {
  Pages(const Catalogue& catalogue, int items_of_page, int processors)
      : catalogue(catalogue),
        items_of_page(static_cast<std::size_t>(items_of_page)),
        count((catalogue.bytes().size() + this->items_of_page - 1) / this->items_of_page),
        bytes(this->items_of_page * catalogue.largest()),
        processors(static_cast<std::size_t>(processors)) {}

  std::size_t page_of(Item item) const { return catalogue.place(item) / items_of_page; }
  int owner(std::size_t page) const { return static_cast<int>(page * processors / count); }
  std::uint64_t resident_bytes(int processor) const {
    std::uint64_t sum = 0;
    for (std::size_t page = 0; page < count; ++page)
      if (owner(page) == processor) sum += bytes;
    return sum;
  }

  const Catalogue& catalogue;
  std::size_t items_of_page, count;  // number of items in a page; number of pages
  std::uint64_t bytes;  // size of a page: items_of_page times the size of the largest item
  std::size_t processors;
};

// Data manager with a block of pages that stays in its memory, and a cache for pages of other
// processors.
class PageManager : public CacheManager {
 public:
  PageManager(DataManagerMeans means, const Pages& pages)
      : CacheManager(std::move(means)), pages_(pages), here_(client().processor()) {}

  std::size_t record_of(Item item) const override { return pages_.page_of(item); }
  bool is_resident(std::size_t page) const override { return pages_.owner(page) == here_; }
  void ask(std::size_t page) override {
    fetch(page, {pages_.owner(page), DATA_PROCESS, Mode::unicast});
  }

 private:
  void handle_request(const Message& message, const DataRequest& request) override {
    this_process().charge(costs_.look_up);
    ++use_.answered;
    reply(message.from, request.record, pages_.bytes, Level::path, message.links);
  }

  void handle_reply(const DataReply& reply) override {
    insert(reply.record);
    use_.request_links += static_cast<std::uint64_t>(reply.links);
    count(Level::path);
  }

  const Pages pages_;
  const int here_;  // number of this processor
};

class WholeManager : public DataManager {
 public:
  using DataManager::DataManager;
  void access(Item /*item*/) override {}

 private:
  void handle_request(const Message& /*message*/, const DataRequest& /*request*/) override {
    throw base::InvariantBroken("a request for data, although every processor has all data");
  }
  void handle_reply(const DataReply& /*reply*/) override {
    throw base::InvariantBroken("a reply with data, although every processor has all data");
  }
};

void check_range(const char* key, int found, int low, int high) {
  if (found < low || found > high)
    base::refuse(key, "found {}, expected {} to {}", found, low, high);
}

void allocate(machine::Processor& processor, const std::string& key, std::uint64_t bytes) {
  auto& memory = processor.memory();
  if (const auto left = memory.left(); bytes > left)
    base::refuse(key, "found {} bytes, expected at most {}, the free memory of {}", bytes, left,
                 processor.name());
  memory.allocate(bytes, key, {});
}

}  // namespace

std::uint64_t longest_message(const machine::Model& model, const Catalogue& catalogue,
                              const DataParams& params) {
  const auto items = params.scheme == Scheme::pages ? params.page_items : 1;
  return std::max(
      get_bytes(model, "data_request"),
      get_bytes(model, "data_reply") + static_cast<std::uint64_t>(items) * catalogue.largest());
}

std::unique_ptr<DataManager> make_whole_manager(network::Network& network,
                                                const machine::Model& model, int processor) {
  return std::make_unique<WholeManager>(DataManagerMeans{
      network.client(processor), network.routing(), DataCosts(model), LruCache({}, 0, "")});
}

VirtualMemory::VirtualMemory(machine::Machine& machine, network::Network& network,
                             const Catalogue& catalogue, const DataParams& params, int first,
                             const std::vector<machine::Processor*>& companions) {
  const auto& routing = network.routing();
  const int n = routing.processors();
  check_range("data.coordinator", params.coordinator, 0, n - 1);
  check_range("data.page_items", params.page_items, 1, 1'000'000);
  for (int id = 0; id < n; ++id) {
    auto& processor = *machine.processors().at(first + id);
    const DataCosts costs(processor.model());
    const bool serves = params.scheme == Scheme::items && id == params.coordinator;
    const std::string key = serves ? "server_cache_percent" : "cache_percent";
    const auto bytes = serves ? params.server_cache_bytes : params.cache_bytes;
    const auto means = [&](std::vector<std::uint64_t> records) {
      LruCache cache(std::move(records), bytes, key);
      allocate(processor, key, bytes);
      return DataManagerMeans{network.client(id), routing, costs, std::move(cache)};
    };
    auto& manager = managers_.emplace_back();
    auto& application = companions_.emplace_back();
    if (serves) {
      manager = std::make_unique<ItemServer>(means(catalogue.bytes()), catalogue);
      continue;
    }
    std::unique_ptr<CacheManager> cached;
    if (params.scheme == Scheme::pages) {
      const Pages pages(catalogue, params.page_items, n);
      cached = std::make_unique<PageManager>(means(std::vector(pages.count, pages.bytes)), pages);
      allocate(processor, "data.resident", pages.resident_bytes(id));
    } else {
      cached = std::make_unique<ItemManager>(means(catalogue.bytes()), catalogue, params);
    }
    if (!companions.empty() && companions.at(id))
      application = std::make_unique<CompanionManager>(
          DataManagerMeans{network.client(id, 1), routing, costs, LruCache({}, 0, "")}, *cached,
          processor, *companions.at(id));
    manager = std::move(cached);
  }
}

DataUse VirtualMemory::use() const {
  DataUse sum;
  for (const auto* all : {&managers_, &companions_})
    for (const auto& manager : *all)
      if (manager) sum += manager->use();
  return sum;
}

void show(observe::ControlPanel& view, const VirtualMemory& memory) {
  const auto share_found = [](const DataUse& use) {
    const auto accesses = use.accesses();
    return accesses == 0 ? 0
                         : 1 - static_cast<double>(use.requests) / static_cast<double>(accesses);
  };
  view.gauges.push_back({"accesses", "accesses to records of the scene",
                         [&memory] { return static_cast<double>(memory.use().accesses()); }});
  view.gauges.push_back({"share found at home", "share of accesses that need no other processor",
                         [&memory, share_found] { return share_found(memory.use()); }});
  view.inspections.emplace_back([&memory, share_found](int id) {
    if (id < 0 || id >= memory.processors()) return std::vector<observe::ControlPanel::Reading>{};
    const auto& manager = memory.manager(id);
    const auto& use = manager.use();
    return std::vector<observe::ControlPanel::Reading>{
        {"bytes in the cache", static_cast<double>(manager.cache().used())},
        {"of", static_cast<double>(manager.cache().capacity())},
        {"accesses", static_cast<double>(use.accesses())},
        {"share found at home", share_found(use)},
        {"requests of others", static_cast<double>(use.seen)}};
  });
}

}  // namespace shared_memory
