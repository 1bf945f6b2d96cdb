#include "base/partial_name.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <system_error>

#include "base/text.hpp"

namespace base {

namespace {

// Returns "KIND-HOST-", with "-" in the host's name doubled.
std::string make_mark(std::string_view kind, std::string_view host) {
  std::string mark(kind);
  mark += '-';
  for (const char c : host) mark += c == '-' ? std::string(2, c) : std::string(1, c);
  return mark + '-';
}

}  // namespace

std::string host_name() {
  char name[HOST_NAME_MAX + 1] = {};
  if (gethostname(name, HOST_NAME_MAX) != 0)
    throw std::system_error(errno, std::generic_category(), "gethostname: no name");
  return name;
}

std::string make_partial_name(std::string_view name, std::string_view kind, pid_t process,
                              std::string_view host) {
  return fmt::format(".{}.{}{}", name, make_mark(kind, host), process);
}

std::optional<pid_t> find_maker(std::string_view partial_name, std::string_view kind,
                                std::string_view host) {
  const auto mark = "." + make_mark(kind, host);
  const auto at = partial_name.rfind(mark);
  if (at == partial_name.npos || !partial_name.starts_with('.')) return std::nullopt;
  const auto rest = partial_name.substr(at + mark.size());
  const auto process = parse_number<pid_t>(rest.substr(0, rest.find('-')));
  return process && *process > 0 ? process : std::nullopt;
}

std::filesystem::path find_final_path(const std::filesystem::path& path) {
  std::filesystem::path found;
  for (const auto& part : path) {
    const auto name = part.string();
    const auto end = name.rfind(".partial-");
    const bool is_hidden = name.starts_with('.') && end != name.npos && end > 1;
    found /= is_hidden ? name.substr(1, end - 1) : name;
  }
  return found;
}

bool is_dead(pid_t process) { return kill(process, 0) != 0 && errno == ESRCH; }

}  // namespace base
