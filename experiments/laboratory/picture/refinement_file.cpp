#include "experiments/laboratory/picture/refinement_file.hpp"

#include <bit>
#include <cstring>
#include <functional>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/host/version.hpp"
#include "renderer/files/load_scene.hpp"

// File format. The file begins with FIRST_LINE, one line "name: value" for each input in the
// identity, and an empty line. Numbers and lists follow in the host's binary format, each list
// preceded by its length. The file ends with a hash of everything before it.
namespace laboratory {
namespace {

using renderer::progressive::Order;
using renderer::progressive::RefinementState;

constexpr std::string_view FIRST_LINE = "state of a tlab rendering\n";
constexpr std::size_t HASH_LENGTH = 32;

// Hashes the scene file and the files that it refers to.
std::string hash_scene(const std::string& path) {
  std::string hashes = hash_of(base::read_text(path));
  for (const auto& further : renderer::find_files(path))
    hashes += hash_of(base::read_text(further));
  return hash_of(hashes);
}

// Passes every number or list of a state to `take`, which reads or writes its bytes.
template <class State, class Take>
void visit(State& state, const Take& take) {
  take(state.done);
  take(state.sums);
  take(state.counts);
  take(state.objects);
  take(state.corners.objects);
  take(state.corner_rows);
  take(state.rays);
  take(state.work.counts);
}

template <class T>
constexpr bool is_list = requires(T t) {
  t.resize(1);
};

struct Writer {
  std::string& bytes;
  void put(const void* from, std::size_t size) const {
    bytes.append(static_cast<const char*>(from), size);
  }
  template <class T>
  void operator()(const T& value) const {
    if constexpr (is_list<T>) {
      const auto length = static_cast<std::uint64_t>(value.size());
      put(&length, sizeof length);
      put(value.data(), value.size() * sizeof value[0]);
    } else {
      static_assert(std::has_unique_object_representations_v<T>);
      put(&value, sizeof value);
    }
  }
};

struct Reader {
  const std::string& path;
  std::string_view& bytes;
  void get(void* to, std::size_t size) const {
    base::require(size <= bytes.size(), path, "found {} bytes of numbers, expected {} more",
                  bytes.size(), size);
    if (size > 0) std::memcpy(to, bytes.data(), size);
    bytes.remove_prefix(size);
  }
  template <class T>
  void operator()(T& value) const {
    if constexpr (is_list<T>) {
      std::uint64_t length = 0;
      get(&length, sizeof length);
      base::require(length <= bytes.size() / sizeof value[0], path,
                    "found a list of {} numbers, expected fewer: the file is too short for them",
                    length);
      value.resize(static_cast<std::size_t>(length));
      get(value.data(), value.size() * sizeof value[0]);
    } else {
      get(&value, sizeof value);
    }
  }
};

// Reads the identity and the empty line after it. Throws if the file has a different identity.
void check_identity(const std::string& path, std::string_view& text, const Identity& identity) {
  const auto take_line = [&] {
    const auto end = std::min(text.find('\n'), text.size());
    const auto line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
  };
  for (const auto& [name, value] : identity) {
    const auto line = take_line();
    base::require(line == fmt::format("{}: {}", name, value), path,
                  "the state of another rendering: found {}, expected {}: {}", line, name, value);
  }
  const auto line = take_line();
  base::require(line.empty(), path,
                "the state of another rendering: found {}, expected an empty line", line);
}

}  // namespace

Identity identify(const std::string& scene, const renderer::Params& params, Order order) {
  Identity identity = {
      {"version", VERSION},
      {"byte order", std::endian::native == std::endian::little ? "little" : "big"},
      renderer::is_scene_file(scene) ? std::pair("hash of the scene", hash_scene(scene))
                                     : std::pair("scene", scene)};
  for (const auto& field : renderer::param_fields())
    identity.emplace_back(field.name, base::to_text(field.get(params)));
  const auto order_of = renderer::progressive::order_field<Order>(std::identity{});
  identity.emplace_back(order_of.name, base::to_text(order_of.get(order)));
  return identity;
}

void save_state(const std::string& path, const Identity& identity, const RefinementState& state) {
  std::string bytes(FIRST_LINE);
  for (const auto& [name, value] : identity) bytes += fmt::format("{}: {}\n", name, value);
  bytes += '\n';
  visit(state, Writer{bytes});
  base::save_whole(path, bytes + hash_of(bytes));
}

RefinementState load_state(const std::string& path, const Identity& identity, std::size_t pixels) {
  // A pixel takes less than 64 bytes. The corners of small pictures and the other data need less
  // than 1 MiB.
  constexpr std::size_t PER_PIXEL = 64, OTHER = 1 << 20;
  const std::string bytes = base::read_own_text(path, OTHER + PER_PIXEL * pixels);
  base::require(bytes.starts_with(FIRST_LINE), path,
                "found another file, expected one that tlab render --state has written");
  std::string_view text(bytes);
  const auto hash = text.substr(text.size() - std::min(text.size(), HASH_LENGTH));
  text.remove_suffix(hash.size());
  const auto expected = hash_of(text);
  base::require(text.size() >= FIRST_LINE.size() && hash == expected, path,
                "damaged: found the hash {}, expected {}", base::quote(hash), expected);
  text.remove_prefix(FIRST_LINE.size());
  check_identity(path, text, identity);
  RefinementState state;
  visit(state, Reader{path, text});
  base::require(text.empty(), path, "found {} bytes more than expected", text.size());
  return state;
}

}  // namespace laboratory
