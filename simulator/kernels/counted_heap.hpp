#pragma once
// A binary heap that counts exchanges of elements, because each is charged to the simulated
// program.
#include <cstdint>
#include <utility>
#include <vector>

namespace kernels {

/// Moves element i up, or down, until the heap property holds. `before(a, b)` is true if a precedes
/// b. Element 0 of a heap precedes all others. Both functions return the number of exchanges.
template <class T, class Before>
std::uint64_t sift_up(std::vector<T>& heap, std::size_t i, Before before) {
  std::uint64_t steps = 0;
  for (; i > 0 && before(heap[i], heap[(i - 1) / 2]); i = (i - 1) / 2, ++steps)
    std::swap(heap[i], heap[(i - 1) / 2]);
  return steps;
}

template <class T, class Before>
std::uint64_t sift_down(std::vector<T>& heap, std::size_t i, Before before) {
  for (std::uint64_t steps = 0;; ++steps) {
    std::size_t first = i;
    for (const std::size_t child : {2 * i + 1, 2 * i + 2})
      if (child < heap.size() && before(heap[child], heap[first])) first = child;
    if (first == i) return steps;
    std::swap(heap[i], heap[first]);
    i = first;
  }
}

/// Turns `heap`, whose elements may be in any order, into a heap. Returns the number of exchanges.
template <class T, class Before>
std::uint64_t make_heap(std::vector<T>& heap, Before before) {
  std::uint64_t steps = 0;
  for (std::size_t i = heap.size() / 2; i-- > 0;) steps += sift_down(heap, i, before);
  return steps;
}

}  // namespace kernels
