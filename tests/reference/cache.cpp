#include "tests/reference/cache.hpp"

#include <cstring>
#include <filesystem>

#include "base/random.hpp"
#include "base/whole_file.hpp"

namespace radiosity::reference {

namespace {

// version of the file format and of the path tracer's results; files of another version are invalid
constexpr int VERSION = 1;

std::uint64_t hash(const std::string& text) {
  std::uint64_t sum = 0;
  for (const char c : text) sum = base::random_at(sum, static_cast<unsigned char>(c));
  return sum;
}

template <class T>
void put(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <class T>
std::vector<T> take(std::string_view& bytes, std::size_t count) {
  std::vector<T> values(count);
  if (bytes.size() < count * sizeof(T)) throw BadInput("a kept reference is too short");
  std::memcpy(values.data(), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
  return values;
}

std::string pack(const Reference& reference) {
  std::string bytes;
  put(bytes, std::vector{reference.picture.width, reference.picture.height});
  put(bytes, reference.picture.pixels);
  put(bytes, reference.error);
  put(bytes, reference.faces);
  put(bytes, std::vector<char>(reference.emits.begin(), reference.emits.end()));
  return bytes;
}

Reference unpack(std::string_view bytes) {
  Reference reference;
  const auto size = take<int>(bytes, 2);
  const auto count = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  reference.picture = {size[0], size[1], take<Rgb>(bytes, count)};
  reference.error = take<double>(bytes, count);
  reference.faces = take<std::uint32_t>(bytes, count);
  const auto emits = take<char>(bytes, count);
  reference.emits.assign(emits.begin(), emits.end());
  return reference;
}

}  // namespace

Reference find_reference(const std::string& text, const Room& room, const TracerParams& params,
                         const std::string& folder) {
  if (folder.empty()) return trace_paths(room, params);
  const std::string key =
      fmt::format("{} {} {} {} {} {} {}\n{}", VERSION, params.width, params.height, params.samples,
                  params.rounds, params.depth, params.seed, text);
  const auto path = std::filesystem::path(folder) / fmt::format("{:016x}.reference", hash(key));
  if (std::filesystem::exists(path)) return unpack(base::read_text(path));
  std::filesystem::create_directories(folder);
  const Reference made = trace_paths(room, params);
  base::save_whole(path, pack(made));
  return made;
}

}  // namespace radiosity::reference
