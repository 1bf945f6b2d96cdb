#pragma once
// Hidden names of files and folders that are being written: ".NAME.partial-HOST-PID". Hosts may
// share a folder, and each knows only its own processes.
#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>

namespace base {

/// The name for a process of this host, ".NAME.KIND-HOST-PID".
std::string make_partial_name(std::string_view name, std::string_view kind, pid_t process);

/// The process of this host that made a name of this kind, whatever follows its number after "-".
std::optional<pid_t> find_maker(std::string_view partial_name, std::string_view kind);

/// Whether there is no such process any more.
bool is_dead(pid_t process);

}  // namespace base
