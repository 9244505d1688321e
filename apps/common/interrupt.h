#pragma once

#include <stdexcept>

#include "apps/common/caller.h"

/// SIGINT and SIGTERM end the program at once, except while a file is being written (afterwards, so that
/// nothing half written or temporary stays behind) and while a computation runs that can be asked to stop.
namespace stackabilization::apps {

/// The user stopped the program.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// As shells report it: 130 after SIGINT, 143 after SIGTERM. Precondition: a signal has come.
int status_interrupted();

void install_interrupt_handler();

/// While it lives a signal is remembered instead of ending the program; a second one ends it. May be nested:
/// the innermost one is told. A caller of its own says itself when to stop; then signals stay as they are.
class DeferredInterrupts {
 public:
  explicit DeferredInterrupts(const Caller* caller = nullptr);
  ~DeferredInterrupts();
  DeferredInterrupts(const DeferredInterrupts&) = delete;
  DeferredInterrupts& operator=(const DeferredInterrupts&) = delete;

  /// Has a signal come since this object was made, or does the caller want to stop?
  bool requested() const;

 private:
  const Caller* caller_;
  bool deferred_before_, remembered_before_;
};

}  // namespace stackabilization::apps
