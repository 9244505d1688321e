#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "stackabilization/io/read.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization::apps {

struct Caller;

/// What every subcommand takes.
struct CommonOptions {
  std::string model;                ///< path of the mesh file, "-" for standard input
  ReadOptions read;                 ///< --format, --unit, --up, --labels
  std::optional<Unit> to_unit;      ///< of meshes that are written; nothing: that of the model
  std::optional<std::string> json;  ///< file for the JSON result, "-" for standard output
  bool quiet = false;               ///< only the essential numbers
  bool no_timing = false;           ///< leave `seconds` out of the JSON
  int threads = 0;                  ///< 0: as many as the machine has
  std::uint64_t seed = 0;    ///< nothing here is random yet; accepted so that scripts can always give one
  Caller* caller = nullptr;  ///< nothing: the terminal
  const CLI::App* command = nullptr;  ///< what was parsed; nothing: MODEL and its options were never added

  bool json_on_stdout() const { return json && *json == "-"; }
};

/// Adds the subcommand `name`, `example` shown below its help.
CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& description,
                      const std::string& example);
/// MODEL and the options of `common`, which must live until the command line is parsed.
void add_common_options(CLI::App& command, CommonOptions& common);

/// --output for a mesh, and --to-unit, which needs it. `what` is written: "the stack".
void add_mesh_output(CLI::App& command, CommonOptions& common, std::optional<std::string>& output,
                     const std::string& what);

/// The value of --threads. Throws UsageError unless it is a number of threads.
int parse_threads(const std::string& text);

/// --semantics, --boxes.
void add_semantics_option(CLI::App& command, ContactSemantics& semantics);
void add_boxes_option(CLI::App& command, BoxModel& boxes);

/// Limits the threads of all parallel loops while it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(const CommonOptions& common);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace stackabilization::apps
