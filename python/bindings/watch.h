#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <thread>

/// A computation that runs without the interpreter's lock.
namespace stackabilization::python {

namespace py = pybind11;

/// Tells a callable how far a computation is, and stops it at Ctrl-C or when the callable raises. Made and
/// ended by the thread that computes, which has the interpreter's lock then.
class Watch {
 public:
  /// `progress`: None, or called as progress(step, fraction).
  explicit Watch(py::object progress);

  /// Called from the thread that made it, without the lock.
  void tell(const std::string& step, double fraction);
  /// Asked from any thread, without the lock.
  bool stopped();
  /// Raises what stopped the computation; nothing did: returns. With the lock.
  void raise_if_stopped();

 private:
  using Clock = std::chrono::steady_clock;

  /// With the lock: runs Python, and stops when that raises.
  template <class Work>
  void guarded(const Work& work);
  void look_for_signals();

  py::object progress_;
  std::thread::id owner_ = std::this_thread::get_id();
  std::atomic<bool> stopped_{false};
  std::optional<py::error_already_set> error_;
  Clock::time_point looked_ = Clock::now();
};

}  // namespace stackabilization::python
