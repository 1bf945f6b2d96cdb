#pragma once
// Hidden names for files and folders that are still being written: ".NAME.partial-HOST-PID", where
// PID is the number of the writing process. The host is part of the name because several hosts may
// share a folder, but each host knows only its own processes. A "-" in the host's name is doubled,
// so that process 3 of host "node-12" cannot be mistaken for process 12 of host "node", whose files
// may end in "-3".
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace base {

std::string host_name();

/// The hidden name ".NAME.KIND-HOST-PID" for process `process` of `host`. `kind` tells what the
/// name is for, such as "partial" for unfinished files.
std::string make_partial_name(std::string_view name, std::string_view kind, pid_t process,
                              std::string_view host = host_name());

/// The process id in a hidden name ".NAME.KIND-HOST-PID"; none if the name is of another kind or
/// host. Ignores any "-" and text after the id.
std::optional<pid_t> find_maker(std::string_view partial_name, std::string_view kind,
                                std::string_view host = host_name());

/// Replaces each hidden name ".NAME.partial-HOST-PID" in the path by NAME.
std::filesystem::path find_final_path(const std::filesystem::path& path);

/// True if no process of this host has the process id.
bool is_dead(pid_t process);

}  // namespace base
