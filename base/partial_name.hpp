#pragma once
// Hidden names for files and folders that are still being written: ".NAME.partial-HOST-PID". The
// host is part of the name because several hosts may share a folder, but each host knows only its
// own processes. A "-" in the host's name is doubled. Otherwise, process "12-3" of host "node"
// would look like process 3 of host "node-12".
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace base {

std::string host_name();

/// The hidden name that process `process` of `host` uses: ".NAME.KIND-HOST-PID".
std::string make_partial_name(std::string_view name, std::string_view kind, pid_t process,
                              std::string_view host = host_name());

/// The process id in a hidden name of this kind; none if another host made the name. Ignores any
/// "-" and text after the id.
std::optional<pid_t> find_maker(std::string_view partial_name, std::string_view kind,
                                std::string_view host = host_name());

/// Replaces each hidden name of this form in the path by the final name.
std::filesystem::path find_final_path(const std::filesystem::path& path);

/// True if no process of this host has the process id.
bool is_dead(pid_t process);

}  // namespace base
