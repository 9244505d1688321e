#include "bindings/job.h"

#include <pthread.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

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

/// Threads that computations run in, one after the other. There are as many as ever ran at once: TBB keeps
/// some memory for every thread that used it, so a thread for each call would let the memory grow.
class Workers {
 public:
  struct Task {
    std::function<void()> work;
    std::function<void()> tell;  ///< called after the work, when the thread is free for the next task
  };

  /// Runs a task in a thread that is idle, or in a new one.
  void start(Task task) {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) {
      auto worker = std::make_unique<Worker>();
      worker->task = std::move(task);
      std::thread([this, own = worker.get()] { serve(*own); }).detach();
      worker.release();
      return;
    }
    Worker* const worker = idle_.back();
    idle_.pop_back();
    worker->task = std::move(task);
    worker->changed.notify_one();
  }

 private:
  struct Worker {
    std::optional<Task> task;
    std::condition_variable changed;
  };

  void serve(Worker& worker) {
    while (true) {
      std::optional<Task> task;
      {
        std::unique_lock lock(mutex_);
        worker.changed.wait(lock, [&] { return worker.task.has_value(); });
        task.swap(worker.task);
      }
      task->work();
      {
        const std::lock_guard lock(mutex_);
        idle_.push_back(&worker);
      }
      task->tell();
    }
  }

  std::mutex mutex_;
  std::vector<Worker*> idle_;  ///< threads live as long as the process
};

/// Never destroyed, because its threads wait on it when the process ends. A fork has none of the threads.
Workers* workers = nullptr;

void make_workers() {
  workers = new Workers;
}

Workers& all_workers() {
  [[maybe_unused]] static const int registered =
      (make_workers(), pthread_atfork(nullptr, nullptr, make_workers));
  return *workers;
}

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
    const auto error = std::make_shared<std::exception_ptr>();
    auto run = [state = state_, error, work = std::move(work)]() mutable {
      try {
        work(*state);
      } catch (...) {
        *error = std::current_exception();
      }
      work = {};  // what it owns goes before anybody is told
    };
    auto tell = [state = state_, error] {
      {
        const std::lock_guard lock(state->mutex);
        state->error = std::move(*error);
        state->ended = true;
        state->changed.notify_all();
      }
      --running;
    };
    all_workers().start({std::move(run), std::move(tell)});
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
