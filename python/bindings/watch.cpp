#include "bindings/watch.h"

#include <utility>

namespace stackabilization::python {

namespace {

constexpr std::chrono::milliseconds between_looks(20);

}  // namespace

Watch::Watch(py::object progress) : progress_(std::move(progress)) {}

template <class Work>
void Watch::guarded(const Work& work) {
  try {
    work();
  } catch (py::error_already_set& error) {
    if (!error_) error_.emplace(error);
    stopped_ = true;
  }
}

void Watch::look_for_signals() {
  looked_ = Clock::now();
  guarded([] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  });
}

void Watch::tell(const std::string& step, double fraction) {
  if (stopped_) return;
  const py::gil_scoped_acquire lock;
  look_for_signals();
  if (!stopped_ && !progress_.is_none()) guarded([&] { progress_(step, fraction); });
}

bool Watch::stopped() {
  if (!stopped_ && std::this_thread::get_id() == owner_ && Clock::now() - looked_ >= between_looks) {
    const py::gil_scoped_acquire lock;
    look_for_signals();
  }
  return stopped_;
}

void Watch::raise_if_stopped() {
  if (error_) throw py::error_already_set(*error_);
}

}  // namespace stackabilization::python
