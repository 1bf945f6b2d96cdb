#include "simulator/shared_memory/columns.hpp"

namespace shared_memory {

namespace {

double share(double part, std::uint64_t all) {
  return all > 0 ? part / static_cast<double>(all) : 0;
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

base::Columns<DataUse> data_columns() {
  return {
      base::column<DataUse>("accesses_made", &DataUse::accesses, "accesses to items"),
      level_column("local", Level::local, "in the processor's own memory"),
      level_column("on_path", Level::path,
                   "in the cache of a processor on the way to the coordinator; with pages, with "
                   "the keeper of the page"),
      level_column("by_queue", Level::queue,
                   "with the reply to a processor that had asked before (WRQu)"),
      level_column("at_coordinator", Level::coordinator, "in the coordinator's cache"),
      level_column("on_disk", Level::disk, "on the disk"),
      base::column("requests", &DataUse::requests, "requests sent to other processors"),
      base::column<DataUse>(
          "links_per_request",
          [](const DataUse& use) {
            return share(static_cast<double>(use.request_links), use.requests);
          },
          "links that a request passes up to the processor that answers, on average"),
      base::column("spared_by_path", &DataUse::spared_by_path,
                   "links that requests were spared by caches on their way"),
      base::column("spared_by_queue", &DataUse::spared_by_queue,
                   "links that requests were spared by queues on their way (WRQu)"),
      base::column<DataUse>(
          "wait_per_request_s",
          [](const DataUse& use) { return share(use.waited.value, use.requests); },
          "mean time from a request to its reply"),
  };
}

}  // namespace shared_memory
