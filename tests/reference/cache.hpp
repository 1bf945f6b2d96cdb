#pragma once
// Cache folder for reference pictures, whose computation takes most of the time.

#include <string>

#include "tests/reference/path_tracer.hpp"

namespace radiosity::reference {

/// Runs trace_paths() for a room given as text, with a cache file in `folder`. The file's name is a
/// hash of the text and of the parameters; it is written if it is missing. An empty `folder`
/// disables the cache. Throws as trace_paths() and base::save_whole() do.
Reference find_reference(const std::string& text, const Room& room, const TracerParams& params,
                         const std::string& folder);

}  // namespace radiosity::reference
