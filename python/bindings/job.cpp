#include "bindings/job.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "stackabilization/core/errors.h"

namespace stackabilization::python {

namespace {

/// How often a waiting thread looks for signals.
constexpr std::chrono::milliseconds between_looks(20);
/// How long a computation may take to stop.
constexpr std::chrono::milliseconds moment(500);

std::atomic<int> running{0};
std::atomic<bool> ending{false};
std::thread::id ending_thread;  ///< written before `ending`

/// Computations that were left alone would use what the end of the process takes apart.
void end_process(int status, void*) {
  if (running == 0) return;
  std::fflush(nullptr);
  _exit(status);
}

void sleep_if_interpreter_ends() {
  if (!ending || std::this_thread::get_id() == ending_thread) return;
  while (true) std::this_thread::sleep_for(std::chrono::hours(1));
}

}  // namespace

void end_of_interpreter() {
  ending_thread = std::this_thread::get_id();
  ending = true;
}

void JobState::tell(const std::string& step, double fraction) {
  const std::lock_guard lock(mutex);
  if (!told.empty() && told.back().first == step)
    told.back().second = fraction;
  else
    told.emplace_back(step, fraction);
  changed.notify_all();
}

Job::Job(std::function<void(JobState&)> work) {
  [[maybe_unused]] static const int registered = on_exit(end_process, nullptr);
  ++running;
  try {
    std::thread([state = state_, work = std::move(work)]() mutable {
      std::exception_ptr error;
      try {
        work(*state);
      } catch (...) {
        error = std::current_exception();
      }
      work = {};  // what it owns goes before anybody is told
      {
        const std::lock_guard lock(state->mutex);
        state->error = std::move(error);
        state->ended = true;
        state->changed.notify_all();
      }
      state.reset();
      --running;
    }).detach();
  } catch (...) {
    --running;
    throw;
  }
}

Job::~Job() {
  stop();
  if (getpid() != process_) return;
  const py::gil_scoped_release unlocked;
  std::unique_lock lock(state_->mutex);
  state_->changed.wait_for(lock, moment, [this] { return state_->ended; });
}

bool Job::ended() const {
  const std::lock_guard lock(state_->mutex);
  return state_->ended;
}

void Job::wait(const py::object& progress, const std::function<bool()>& enough) {
  if (getpid() != process_) throw UsageError("a computation cannot be waited for in another process");
  while (true) {
    std::deque<std::pair<std::string, double>> told;
    bool done = false, is_enough = false;
    {
      const py::gil_scoped_release unlocked;
      std::unique_lock lock(state_->mutex);
      state_->changed.wait_for(lock, between_looks, [&] {
        is_enough = enough && enough();
        return is_enough || state_->ended || !state_->told.empty();
      });
      told.swap(state_->told);
      done = state_->ended;
      lock.unlock();
      sleep_if_interpreter_ends();
    }
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress.is_none())
        for (const auto& [step, fraction] : told) progress(step, fraction);
    } catch (...) {
      stop();
      throw;
    }
    if (is_enough) return;
    if (done) {
      if (state_->error) std::rethrow_exception(state_->error);
      return;
    }
  }
}

}  // namespace stackabilization::python
