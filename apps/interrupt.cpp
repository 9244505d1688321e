#include "apps/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <string_view>

namespace stackabilization::apps {

namespace {

std::atomic<bool> deferred{false};
std::atomic<bool> remembered{false};
static_assert(std::atomic<bool>::is_always_lock_free, "signal handlers may only touch lock-free atomics");

void on_signal(int) {
  if (deferred && !remembered.exchange(true)) return;
  constexpr std::string_view message = "stackabilize: interrupted\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message.data(), message.size());
  _exit(status_interrupted);
}

}  // namespace

void install_interrupt_handler() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

DeferredInterrupts::DeferredInterrupts()
    : deferred_before_(deferred.exchange(true)), remembered_before_(remembered) {}

DeferredInterrupts::~DeferredInterrupts() {
  deferred = deferred_before_;
}

bool DeferredInterrupts::requested() const {
  return remembered && !remembered_before_;
}

}  // namespace stackabilization::apps
