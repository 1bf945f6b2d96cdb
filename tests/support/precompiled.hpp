#pragma once
// What nearly every test includes, compiled once (CMakeLists.txt). A test includes what it uses all
// the same: builds with a compiler cache do without this.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <ranges>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <variant>
#include <vector>
