#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/caller.h"
#include "apps/interrupt.h"
#include "apps/program.h"
#include "bindings/bindings.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::python {

namespace {

/// How often a waiting thread looks for signals.
constexpr std::chrono::milliseconds between_signal_checks(50);

using Meshes = std::map<std::string, std::shared_ptr<Shape>>;

/// A run of `improve` in a thread of its own, which the interpreter takes designs from.
class ImprovementThread {
 public:
  ImprovementThread(std::vector<std::string> arguments, const Meshes& meshes,
                    std::map<std::string, std::string> projects)
      : arguments_(std::move(arguments)) {
    caller_.meshes.insert(meshes.begin(), meshes.end());
    caller_.projects = std::move(projects);
    caller_.stopped = [this] { return stopped_.load(); };
    caller_.progress = [this](const std::string& step, double fraction) {
      const std::lock_guard lock(mutex_);
      progress_ = {step, fraction};
      changed_.notify_all();
    };
    caller_.found = [this](const apps::Json& solution, const Shape& shape) {
      const std::lock_guard lock(mutex_);
      designs_.emplace_back(solution.dump(), std::make_shared<Shape>(shape));
      changed_.notify_all();
    };
    thread_ = std::thread([this] { run(); });
  }

  ~ImprovementThread() {
    const py::gil_scoped_release unlocked;
    stopped_ = true;
    thread_.join();
  }
  ImprovementThread(const ImprovementThread&) = delete;
  ImprovementThread& operator=(const ImprovementThread&) = delete;

  /// The next design that is found as (JSON, mesh), None at the end. Raises what ended the run, or what
  /// `progress` or a signal raised meanwhile, after which the run stops.
  py::object next(const py::object& progress) {
    while (true) {
      std::optional<std::pair<std::string, std::shared_ptr<Shape>>> design;
      std::optional<std::pair<std::string, double>> told;
      bool ended = false;
      {
        const py::gil_scoped_release unlocked;
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, between_signal_checks,
                          [&] { return !designs_.empty() || progress_ || ended_; });
        if (!designs_.empty()) {
          design = std::move(designs_.front());
          designs_.pop_front();
        }
        told.swap(progress_);
        ended = ended_;
      }
      check_signals_and_tell(progress, told);
      if (design) return py::make_tuple(design->first, design->second);
      if (ended) {
        if (error_) std::rethrow_exception(error_);
        return py::none();
      }
    }
  }

  /// (exit status, JSON, meshes, texts) of the run that has ended.
  py::tuple result() const {
    py::dict written;
    for (const auto& [name, shape] : caller_.written_meshes)
      written[py::str(name)] = std::make_shared<Shape>(shape);
    return py::make_tuple(status_, caller_.document.dump(), written, caller_.written_texts);
  }

  void stop() { stopped_ = true; }

 private:
  void run() {
    try {
      apps::Program program(&caller_);
      program.parse(arguments_);
      status_ = program.run();
    } catch (...) {
      error_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }

  void check_signals_and_tell(const py::object& progress,
                              const std::optional<std::pair<std::string, double>>& told) {
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (told && !progress.is_none()) progress(told->first, told->second);
    } catch (...) {
      stopped_ = true;
      throw;
    }
  }

  std::vector<std::string> arguments_;
  apps::Caller caller_;
  std::atomic<bool> stopped_{false};
  int status_ = 0;            ///< written before `ended_`
  std::exception_ptr error_;  ///< the same

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::pair<std::string, std::shared_ptr<Shape>>> designs_;
  std::optional<std::pair<std::string, double>> progress_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace

void add_improvement(py::module_& module) {
  using namespace py::literals;
  py::class_<ImprovementThread>(module, "ImprovementThread")
      .def(py::init<std::vector<std::string>, const Meshes&, std::map<std::string, std::string>>(),
           "arguments"_a, "meshes"_a, "projects"_a)
      .def("next", &ImprovementThread::next, "progress"_a)
      .def("result", &ImprovementThread::result)
      .def("stop", &ImprovementThread::stop);
}

}  // namespace stackabilization::python
