#pragma once
// PROTOCOL with CASE: a message is one of several alternatives (std::variant).
//
//   in(from_coord, request);
//   case_of(request, [&](const Ray& ray) { ... },
//                    [&](const Limits& limits) { ... },
//                    [&](const auto&) { ... });  // ELSE
#include <utility>
#include <variant>

namespace occam {

template <class... Cases>
struct Overloads : Cases... {
  using Cases::operator()...;
};

/// Calls the function for the alternative that the message holds, and returns its result. The
/// message is a variant, or a struct with a variant named `content`. Every alternative needs a
/// function.
template <class Message, class... Cases>
decltype(auto) case_of(const Message& message, Cases... cases) {
  Overloads<Cases...> overloads{std::move(cases)...};
  if constexpr (requires { message.content; })
    return std::visit(overloads, message.content);
  else
    return std::visit(overloads, message);
}

}  // namespace occam
