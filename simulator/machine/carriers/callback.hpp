#pragma once
// A type for the callbacks of events.
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>

namespace machine {

/// A small function object that is copied byte by byte. The event queue moves callbacks millions of
/// times; each move of a std::function would need an allocation or an indirect call.
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
  /// Prefetches the object that the first captured variable of the callback points to. If that
  /// variable is not a pointer, the prefetch is useless but harmless.
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
