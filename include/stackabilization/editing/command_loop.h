#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "stackabilization/editing/session.h"

namespace stackabilization::editing {

/// Runs a session on a thread of its own, and its jobs on one thread per lane. Functions that are posted run
/// one after the other, in their order; so do the listener of the session and the results of jobs.
class CommandLoop {
 public:
  /// Work with the session on its thread. Must not throw.
  using Task = std::function<void(EditingSession&)>;

  /// Starts the threads. Nobody else may use the session from now on, but for its listener.
  explicit CommandLoop(std::unique_ptr<EditingSession> session);
  /// Drops what waits, cancels jobs, and waits for their end.
  ~CommandLoop();
  CommandLoop(const CommandLoop&) = delete;
  CommandLoop& operator=(const CommandLoop&) = delete;

  /// Appends a task. May be called from any thread.
  void post(Task task);
  /// Appends a drag. Where a drag of the same source waits as the last task already, it is replaced: a drag
  /// that is slower than the mouse leaves out steps.
  void post_drag(Task task, std::uint64_t source);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stackabilization::editing
