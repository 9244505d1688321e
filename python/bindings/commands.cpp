#include <pybind11/stl.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/common/caller.h"
#include "apps/common/common_options.h"
#include "apps/common/program.h"
#include "bindings/bindings.h"
#include "bindings/job.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::python {

namespace {

/// What a command leaves.
struct Answer {
  int status = 0;
  std::string document;
  std::map<std::string, std::shared_ptr<Shape>> meshes;
  std::map<std::string, std::string> texts;
};

Answer answer_of(const std::vector<std::string>& arguments, const Meshes& meshes,
                 const std::map<std::string, std::string>& projects, JobState& job) {
  apps::Caller caller;
  caller.meshes.insert(meshes.begin(), meshes.end());
  caller.projects = projects;
  caller.progress = [&job](const std::string& step, double fraction) { job.tell(step, fraction); };
  caller.stopped = [&job] { return job.stopped.load(); };
  apps::Program program(&caller);
  program.parse(arguments);
  Answer answer;
  answer.status = program.run();
  answer.document = caller.document.dump();
  for (auto& [name, shape] : caller.written_meshes)
    answer.meshes.emplace(name, std::make_shared<Shape>(std::move(shape)));
  answer.texts = std::move(caller.written_texts);
  return answer;
}

/// Runs a command of the program on meshes in memory.
py::tuple run(const std::vector<std::string>& arguments, const Meshes& meshes,
              const std::map<std::string, std::string>& projects, const py::object& progress) {
  const Answer answer =
      run_as_job(progress, [=](JobState& job) { return answer_of(arguments, meshes, projects, job); });
  return py::make_tuple(answer.status, answer.document, answer.meshes, answer.texts);
}

/// Reads a mesh file as the commands do.
std::shared_ptr<Shape> read(std::vector<std::string> arguments) {
  CLI::App app;
  apps::CommonOptions common;
  apps::add_common_options(app, common);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  app.parse(std::move(arguments));
  return run_as_job(py::none(), [model = common.model, options = common.read](JobState&) {
    return std::make_shared<Shape>(read_shape(model, options));
  });
}

/// What a command takes: per option its names, what it expects ("" for a flag) and what it means.
py::list options(const std::string& name) {
  const apps::Program program;
  py::list list;
  for (const apps::OptionOfCommand& option : program.options(name)) {
    py::dict entry;
    entry["names"] = option.names;
    entry["expects"] = option.expects;
    entry["meaning"] = option.meaning;
    list.append(entry);
  }
  return list;
}

}  // namespace

void add_commands(py::module_& module) {
  using namespace py::literals;
  module.def("run", &run, "arguments"_a, "meshes"_a, "projects"_a, "progress"_a,
             "Returns (exit status, JSON, meshes written, texts written) of a command of the program.");
  module.def("read", &read, "arguments"_a, "Reads a mesh file; the arguments are those of the program.");
  module.def(
      "commands", [] { return apps::Program().command_names(); }, "Names of the program's commands.");
  module.def("options", &options, "command"_a,
             "What a command of the program takes: a dict of names, expects and meaning per option.");
  module.def("end_of_interpreter", &end_of_interpreter, "To be called when the interpreter is about to end.");
}

}  // namespace stackabilization::python
