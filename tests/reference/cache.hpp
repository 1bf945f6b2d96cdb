#pragma once
// Cache of reference pictures, because computing them takes most of the time.

#include <string>

#include "tests/reference/path_tracer.hpp"

namespace radiosity::reference {

/// Calls trace_paths() for a room whose text is `text`, or loads the result of an earlier call from
/// `folder`. The name of the cache file is a hash of the text and the parameters; a missing file is
/// written. If `folder` is "", nothing is cached. Throws as trace_paths() and base::save_whole()
/// do.
Reference find_reference(const std::string& text, const Room& room, const TracerParams& params,
                         const std::string& folder);

}  // namespace radiosity::reference
