#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace stackabilization::python {

namespace py = pybind11;

/// What a computation and the thread that waits for it share; it lives as long as either.
struct JobState {
  /// Called by the computation from any thread: the calling thread tells its `progress` so.
  void tell(const std::string& step, double fraction);

  std::mutex mutex;                 ///< guards what follows, and what the computation hands over
  std::condition_variable changed;  ///< notified when that changes
  std::deque<std::pair<std::string, double>> told;  ///< not told yet; of each step the last fraction
  bool ended = false;
  std::exception_ptr error;          ///< what the computation threw
  std::atomic<bool> stopped{false};  ///< asked by the computation: is it to end early?
};

/// A computation in another thread, so that the calling thread can look after Python meanwhile: it tells
/// `progress` how far the computation is, and at Ctrl-C, or when `progress` raises, asks it to stop. One that
/// does not stop within a moment is left alone, and ends without anybody who looks at its result.
///
/// All members are called with the interpreter's lock, and release it while they wait.
class Job {
 public:
  /// `work` owns everything that it uses, because it may outlive the job, and touches no Python object.
  explicit Job(std::function<void(JobState&)> work);
  /// Asks the computation to stop, and waits a moment for it.
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Returns when the computation has ended or `enough`, which is asked under the mutex, says so. Raises what
  /// ended the computation, and what `progress` or a signal raised meanwhile.
  void wait(const py::object& progress, const std::function<bool()>& enough = {});
  /// Has the computation ended?
  bool ended() const;
  void stop() { state_->stopped = true; }
  JobState& state() { return *state_; }

 private:
  std::shared_ptr<JobState> state_ = std::make_shared<JobState>();
  pid_t process_ = getpid();  ///< threads do not follow a fork
};

/// Runs `work`, which returns a value, as a Job to its end, and returns that value. `progress` may be None.
template <class Work>
auto run_as_job(const py::object& progress, Work work) {
  auto result = std::make_shared<decltype(work(std::declval<JobState&>()))>();
  Job job([result, work = std::move(work)](JobState& state) mutable { *result = work(state); });
  job.wait(progress);
  return std::move(*result);
}

/// Called by Python when the interpreter is about to end: other threads that wait for a job wait on for good,
/// because they could not go on without the interpreter.
void end_of_interpreter();

}  // namespace stackabilization::python
