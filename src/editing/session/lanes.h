#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>

#include "stackabilization/editing/session.h"

namespace stackabilization::editing {

/// Whether a job was cancelled; shared by the session and the job.
using Cancelled = std::shared_ptr<std::atomic<bool>>;
/// Passes a result of a job to the thread of the session.
using Deliver = std::function<void(EditingSession::Result)>;
/// Work of a job. May throw.
using JobWork = std::function<void(const Cancelled&, const Deliver&)>;

/// The lanes of a session: which jobs run, and how they are cancelled.
class Lanes {
 public:
  /// Receives what a job threw, on the thread of the session.
  using FailureListener = std::function<void(Lane lane, const std::string& sentence)>;

  explicit Lanes(FailureListener failed) : failed_(std::move(failed)) {}

  /// Says whether a job of this lane was handed out and has not ended yet.
  bool is_running(Lane lane) const { return state_of(lane).running; }
  /// Makes a job of work. Precondition: none is running there.
  EditingSession::Job start(Lane lane, JobWork work);
  /// Cancels the job of a lane, if there is one.
  void cancel(Lane lane);
  /// Cancels all jobs.
  void cancel_all();

 private:
  struct State {
    bool running = false;
    Cancelled cancelled;
  };
  const State& state_of(Lane lane) const { return states_[static_cast<std::size_t>(lane)]; }
  State& state_of(Lane lane) { return states_[static_cast<std::size_t>(lane)]; }

  FailureListener failed_;
  std::array<State, 2> states_;
};

/// Returns a result that is dropped once the job was cancelled.
template <class Function>
EditingSession::Result unless(const Cancelled& cancelled, Function function) {
  return [cancelled, function = std::move(function)] {
    if (!*cancelled) function();
  };
}

}  // namespace stackabilization::editing
