#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/common/command.h"

namespace stackabilization::apps {

/// An option of a command, as the help shows it.
struct OptionOfCommand {
  std::vector<std::string> names;  ///< "--output", "-o"
  std::string expects;             ///< "FILE", "solid|closed"; empty for a flag
  std::string meaning;
};

/// `stackabilize` with all its commands, for one command line.
class Program {
 public:
  /// `caller`: who runs the commands in its own process; nothing: the terminal.
  explicit Program(Caller* caller = nullptr);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// `arguments` without the name of the program. Throws UsageError or CLI::Error for a wrong command line,
  /// CLI::Success when help or the version was asked for.
  void parse(std::vector<std::string> arguments);
  /// Runs the command that was parsed and returns the exit status. Throws the errors of the library.
  int run();
  std::vector<std::string> command_names() const;
  /// Of the command of this name. Throws UsageError when there is none.
  std::vector<OptionOfCommand> options(const std::string& command) const;
  /// Both; prints help or the version where that was asked for.
  int parse_and_run(std::vector<std::string> arguments);

 private:
  std::unique_ptr<CLI::App> app_;
  std::vector<Command> commands_;
};

/// The exit status that `body` returns, or that of what it throws, after one sentence on standard error.
int guarded(const std::function<int()>& body);

}  // namespace stackabilization::apps
