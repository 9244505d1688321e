#include <pybind11/stl.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/caller.h"
#include "apps/common_options.h"
#include "apps/interrupt.h"
#include "apps/program.h"
#include "bindings/bindings.h"
#include "bindings/watch.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::python {

namespace {

/// Runs a command of the program on meshes in memory.
py::tuple run(const std::vector<std::string>& arguments,
              const std::map<std::string, std::shared_ptr<Shape>>& meshes,
              const std::map<std::string, std::string>& projects, const py::object& progress) {
  Watch watch(progress);
  apps::Caller caller;
  caller.meshes.insert(meshes.begin(), meshes.end());
  caller.projects = projects;
  caller.progress = [&watch](const std::string& step, double fraction) { watch.tell(step, fraction); };
  caller.stopped = [&watch] { return watch.stopped(); };
  int status = 0;
  try {
    const py::gil_scoped_release unlocked;
    apps::Program program(&caller);
    program.parse(arguments);
    status = program.run();
  } catch (const apps::Interrupted&) {
    watch.raise_if_stopped();
    throw;
  }
  watch.raise_if_stopped();  // by the last thing it was told
  py::dict written;
  for (auto& [name, shape] : caller.written_meshes)
    written[py::str(name)] = std::make_shared<Shape>(std::move(shape));
  return py::make_tuple(status, caller.document.dump(), written, caller.written_texts);
}

/// Reads a mesh file as the commands do.
std::shared_ptr<Shape> read(std::vector<std::string> arguments) {
  CLI::App app;
  apps::CommonOptions common;
  apps::add_common_options(app, common);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  app.parse(std::move(arguments));
  const py::gil_scoped_release unlocked;
  return std::make_shared<Shape>(read_shape(common.model, common.read));
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
}

}  // namespace stackabilization::python
