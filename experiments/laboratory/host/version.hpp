#pragma once

namespace laboratory {

constexpr const char* VERSION = TLAB_VERSION;  // the project's, from CMake

}  // namespace laboratory
