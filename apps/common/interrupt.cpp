#include "apps/common/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <string_view>

namespace stackabilization::apps {

namespace {

std::atomic<bool> deferred{false};
std::atomic<int> remembered{0};  ///< the first signal that came
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "signal handlers may only touch lock-free atomics");

int status_after(int signal) {
  constexpr int first = 128;
  return first + signal;
}

void on_signal(int signal) {
  int none = 0;
  if (remembered.compare_exchange_strong(none, signal) && deferred) return;
  constexpr std::string_view message = "stackabilize: interrupted\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message.data(), message.size());
  _exit(status_after(signal));
}

}  // namespace

int status_interrupted() {
  return status_after(remembered);
}

void install_interrupt_handler() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

DeferredInterrupts::DeferredInterrupts(const Caller* caller)
    : caller_(caller),
      deferred_before_(caller ? deferred.load() : deferred.exchange(true)),
      remembered_before_(remembered != 0) {}

DeferredInterrupts::~DeferredInterrupts() {
  if (!caller_) deferred = deferred_before_;
}

bool DeferredInterrupts::requested() const {
  if (caller_) return caller_->stopped && caller_->stopped();
  return remembered != 0 && !remembered_before_;
}

}  // namespace stackabilization::apps
