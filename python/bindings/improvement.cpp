#include <pybind11/stl.h>

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/common/caller.h"
#include "apps/common/program.h"
#include "bindings/bindings.h"
#include "bindings/job.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::python {

namespace {

/// A run of `improve`, which the interpreter takes designs from as they are found.
class ImprovementRun {
 public:
  ImprovementRun(std::vector<std::string> arguments, Meshes meshes,
                 std::map<std::string, std::string> projects)
      : job_([found = found_, arguments = std::move(arguments), meshes = std::move(meshes),
              projects = std::move(projects)](JobState& job) {
          apps::Caller& caller = found->caller;
          caller.meshes.insert(meshes.begin(), meshes.end());
          caller.projects = projects;
          caller.stopped = [&job] { return job.stopped.load(); };
          caller.progress = [&job](const std::string& step, double fraction) { job.tell(step, fraction); };
          caller.found = [&job, &designs = found->designs](const apps::Json& solution, const Shape& shape) {
            const std::lock_guard lock(job.mutex);
            designs.emplace_back(solution.dump(), std::make_shared<Shape>(shape));
            job.changed.notify_all();
          };
          apps::Program program(&caller);
          program.parse(arguments);
          found->status = program.run();
        }) {}

  /// The next design that is found as (JSON, mesh), None at the end. Raises as Job::wait.
  py::object next(const py::object& progress) {
    std::deque<Design>& designs = found_->designs;
    job_.wait(progress, [&designs] { return !designs.empty(); });
    std::optional<Design> design;
    {
      const std::lock_guard lock(job_.state().mutex);
      if (!designs.empty()) {
        design = std::move(designs.front());
        designs.pop_front();
      }
    }
    return design ? py::object(py::make_tuple(design->first, design->second)) : py::none();
  }

  /// (exit status, JSON, meshes, texts) of the run. Throws UsageError unless it has ended.
  py::tuple result() const {
    if (!job_.ended()) throw UsageError("the improvement has not ended yet");
    const apps::Caller& caller = found_->caller;
    py::dict written;
    for (const auto& [name, shape] : caller.written_meshes)
      written[py::str(name)] = std::make_shared<Shape>(shape);
    return py::make_tuple(found_->status, caller.document.dump(), written, caller.written_texts);
  }

  void stop() { job_.stop(); }

 private:
  using Design = std::pair<std::string, std::shared_ptr<Shape>>;

  struct Found {
    apps::Caller caller;
    int status = 0;
    std::deque<Design> designs;  ///< guarded by the mutex of the job
  };

  std::shared_ptr<Found> found_ = std::make_shared<Found>();
  Job job_;
};

}  // namespace

void add_improvement(py::module_& module) {
  using namespace py::literals;
  py::class_<ImprovementRun>(module, "ImprovementRun")
      .def(py::init<std::vector<std::string>, Meshes, std::map<std::string, std::string>>(), "arguments"_a,
           "meshes"_a, "projects"_a)
      .def("next", &ImprovementRun::next, "progress"_a)
      .def("result", &ImprovementRun::result)
      .def("stop", &ImprovementRun::stop);
}

}  // namespace stackabilization::python
