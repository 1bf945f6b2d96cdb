#pragma once
// Parts shared by the functions that write traces: checks, rounding to nanoseconds, buffered
// output.
#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <string_view>

#include "simulator/observe/trace.hpp"

namespace observe {

/// Throws base::InvariantBroken if an index is out of range or an item ends before its start. Also
/// throws if items of one processor or link overlap, or are out of order, by more than a
/// nanosecond.
void check(const Trace& trace);

/// Rounds to whole nanoseconds. Rounding keeps the order of times, so spans that do not overlap
/// still do not overlap.
inline std::int64_t to_nanoseconds(double time_s) { return std::llround(time_s * 1e9); }

/// Collects text and writes it to a stream, about a megabyte at a time. flush() must be called
/// last.
class TraceOutput {
 public:
  explicit TraceOutput(std::ostream& out) : out_(out) { buffer_.reserve(PIECE + PIECE / 8); }

  /// `format` must be an FMT_COMPILE(...).
  template <class Format, class... Args>
  void print(const Format& format, const Args&... args) {
    fmt::format_to(fmt::appender(buffer_), format, args...);
    if (buffer_.size() >= PIECE) flush();
  }

  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

 private:
  static constexpr std::size_t PIECE = 1 << 20;
  std::ostream& out_;
  fmt::memory_buffer buffer_;
};

}  // namespace observe
