#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/command.h"

namespace stackabilization::apps {

/// `stackabilize` with all its commands, for one command line.
class Program {
 public:
  Program();
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// `arguments` without the name of the program. Throws UsageError or CLI::Error for a wrong command line,
  /// CLI::Success when help or the version was asked for.
  void parse(std::vector<std::string> arguments);
  /// Runs the command that was parsed and returns the exit status. Throws the errors of the library.
  int run();
  /// Both; prints help or the version where that was asked for.
  int parse_and_run(std::vector<std::string> arguments);

 private:
  std::unique_ptr<CLI::App> app_;
  std::vector<Command> commands_;
};

/// The exit status that `body` returns, or that of what it throws, after one sentence on standard error.
int guarded(const std::function<int()>& body);

}  // namespace stackabilization::apps
