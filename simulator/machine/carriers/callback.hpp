#pragma once
// What to do at an event.
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>

namespace machine {

/// A small function object, copied as plain bytes (std::function costs an allocation or a call to
/// move, millions of times).
class Callback {
 public:
  Callback() = default;
  template <class Body>
  requires(!std::is_same_v<Body, Callback>) Callback(Body body)
      : call_([](void* at) { (*static_cast<Body*>(at))(); }) {
    if constexpr (sizeof(Body) < sizeof(std::uintptr_t))
      std::memset(body_, 0, sizeof(std::uintptr_t));
    static_assert(sizeof(Body) <= sizeof body_ && std::is_trivially_copyable_v<Body>);
    new (body_) Body(body);
  }
  void operator()() { call_(body_); }
  /// Asks the host to fetch the object that the body is about, if it begins with a pointer. (If
  /// not, something else is fetched, or nothing.)
  void prefetch() const {
    std::uintptr_t at = 0;
    std::memcpy(&at, body_, sizeof at);
    for (int line = 0; line < 4; ++line)
      __builtin_prefetch(reinterpret_cast<const void*>(at + 64 * line));
  }

 private:
  void (*call_)(void*) = nullptr;
  alignas(8) unsigned char body_[24];
};

}  // namespace machine
