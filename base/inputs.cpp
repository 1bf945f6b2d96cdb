#include "base/inputs.hpp"

#include <sys/stat.h>

#include <mutex>
#include <optional>
#include <set>
#include <tuple>

#include "base/errors.hpp"

namespace base {

namespace {

// Device, inode and time of the last modification.
using Identity = std::tuple<dev_t, ino_t, time_t, long>;

std::mutex inputs_mutex;
std::optional<std::set<Identity>> inputs;  // none without an InputGuard

Identity identify(const struct stat& file) {
  return {file.st_dev, file.st_ino, file.st_mtim.tv_sec, file.st_mtim.tv_nsec};
}

}  // namespace

InputGuard::InputGuard() {
  const std::lock_guard lock(inputs_mutex);
  inputs.emplace();
}

InputGuard::~InputGuard() {
  const std::lock_guard lock(inputs_mutex);
  inputs.reset();
}

void note_input(const struct stat& file) {
  const std::lock_guard lock(inputs_mutex);
  if (inputs) inputs->insert(identify(file));
}

void check_no_input(const std::filesystem::path& path) {
  struct stat file {};
  if (stat(path.c_str(), &file) != 0) return;
  const std::lock_guard lock(inputs_mutex);
  require(!inputs || !inputs->contains(identify(file)), path.string(),
          "cannot be written: the command reads this file, expected another name");
}

}  // namespace base
