#include "base/early_end.hpp"

#include <unistd.h>

#include <atomic>
#include <mutex>
#include <ranges>
#include <shared_mutex>
#include <utility>

namespace base {

namespace {

std::atomic<bool> is_ending = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // required in signal handlers

std::shared_mutex sections;  // locked (shared) by every thread that is in a section
thread_local int depth = 0;  // number of nested sections that this thread is in

std::mutex list_mutex;
std::list<std::function<void()>> undos;

}  // namespace

Undivided::Undivided() {
  if (depth++ > 0) return;
  while (is_ending) pause();
  sections.lock_shared();
}

Undivided::~Undivided() {
  if (--depth == 0) sections.unlock_shared();
}

Undo::Undo(std::function<void()> undo) {
  const Undivided section;
  const std::lock_guard lock(list_mutex);
  place_ = undos.insert(undos.end(), std::move(undo));
}

Undo::~Undo() {
  const Undivided section;
  const std::lock_guard lock(list_mutex);
  undos.erase(place_);
}

void request_early_end() noexcept { is_ending = true; }

void undo_all() {
  request_early_end();
  // If the program ends for lack of memory, the calling thread may still be inside a section. It
  // leaves the section here, because it would otherwise wait for itself.
  if (std::exchange(depth, 0) > 0) sections.unlock_shared();
  sections.lock();
  for (const auto& undo : undos | std::views::reverse) try {
      undo();
    } catch (const std::exception&) {  // one failed Undo must not prevent the remaining ones
    }
}

HeldSignals::HeldSignals(std::span<const int> signals) {
  sigset_t held;
  sigemptyset(&held);
  for (const int signal : signals) sigaddset(&held, signal);
  pthread_sigmask(SIG_BLOCK, &held, &before_);
}

HeldSignals::~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace base
