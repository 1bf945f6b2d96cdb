#pragma once
// Hidden names for files and folders that are still being written: ".NAME.partial-HOST-PID". The
// host is part of the name because hosts may share a folder and know only their own processes. A
// "-" in the host's name is doubled. Without that, process "12-3" of "node" would look like process
// 3 of "node-12".
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace base {

std::string host_name();

/// The name made by a process of a host: ".NAME.KIND-HOST-PID".
std::string make_partial_name(std::string_view name, std::string_view kind, pid_t process,
                              std::string_view host = host_name());

/// The process id in a name of this kind made by `host`. Ignores any "-" and text after the id.
std::optional<pid_t> find_maker(std::string_view partial_name, std::string_view kind,
                                std::string_view host = host_name());

/// The path with hidden names of this form replaced by the final ones.
std::filesystem::path find_final_path(const std::filesystem::path& path);

/// True if the process no longer exists.
bool is_dead(pid_t process);

}  // namespace base
