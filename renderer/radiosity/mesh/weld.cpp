#include "renderer/radiosity/mesh/weld.hpp"

namespace radiosity {

namespace {

constexpr double PLACES = 1e9, NORMALS = 1 << 24;

}  // namespace

Welder::Welder(double size) : unit_(1) {
  if (!(size > 0)) return;
  int exponent = 0;
  std::frexp(size / PLACES, &exponent);
  unit_ = std::ldexp(1.0, exponent);
}

std::size_t Welder::Hash::operator()(const Key& key) const {
  std::uint64_t hash = 0;
  for (const auto part : key) {
    hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  }
  return hash;
}

std::uint32_t Welder::weld(const Vec& at, const Vec& normal, std::uint32_t material) {
  const auto cell = [&](double x) { return std::llround(x / unit_); };
  const auto turn = [](double x) { return std::llround(x * NORMALS); };
  const Key key{cell(at.x),     cell(at.y),     cell(at.z), turn(normal.x),
                turn(normal.y), turn(normal.z), material};
  return known_.try_emplace(key, static_cast<std::uint32_t>(known_.size())).first->second;
}

}  // namespace radiosity
