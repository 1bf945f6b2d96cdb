#include "experiments/laboratory/file/data_schema.hpp"

namespace laboratory {

namespace {

const Names<shared_memory::Scheme> SCHEMES = {{"items", shared_memory::Scheme::items},
                                              {"pages", shared_memory::Scheme::pages}};
const Names<network::Method> METHODS = {{"green", network::Method::green},
                                        {"chalmers", network::Method::chalmers},
                                        {"acyclic", network::Method::acyclic}};

template <class Read>
Binding<Experiment> bind(const char* key, const char* help, Read read) {
  return {key, help, [read](Experiment& e, const Place& at) {
            read(e.data, at);
            e.has_data = true;
          }};
}

}  // namespace

const std::vector<Binding<Experiment>>& data_bindings() {
  using D = farm::SharedParams;
  using P = Place;
  static const std::vector<Binding<Experiment>> all = {
      bind("data.cache_percent",
           "cache of a worker, of the scene's bytes, for blocks as tasks; 0: it holds the scene",
           [](D& d, const P& at) { d.cache_percent = read_double(at, 0, 100); }),
      bind("data.server_cache_percent", "cache of the coordinator, with items",
           [](D& d, const P& at) { d.server_cache_percent = read_double(at, 0, 100); }),
      bind("data.scheme", "items, in caches on the way to the coordinator; or pages, spread",
           [](D& d, const P& at) { d.scheme = read_name(at, SCHEMES); }),
      bind("data.in_path", "true: requests are offered to all on the way",
           [](D& d, const P& at) { d.in_path = read_bool(at); }),
      bind("data.waiting_queue", "true: who waits for an item shares it with who asks for it",
           [](D& d, const P& at) { d.waiting_queue = read_bool(at); }),
      bind("data.page_items", "items of a page",
           [](D& d, const P& at) { d.page_items = int(read_int(at, 1, 1'000'000)); }),
      bind("data.method", "how routers avoid deadlock: green, chalmers or acyclic",
           [](D& d, const P& at) { d.method = read_name(at, METHODS); }),
  };
  return all;
}

}  // namespace laboratory
