#include "apps/common/completion.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "apps/common/program.h"
#include "apps/common/text.h"

namespace stackabilization::apps {

namespace {

/// The names among what an option expects, as in "solid|closed" or "A|auto".
std::vector<std::string> named_values(const std::string& expects) {
  std::vector<std::string> values;
  if (expects.find('|') == std::string::npos || expects.find('=') != std::string::npos) return values;
  std::istringstream parts(expects);
  for (std::string part; std::getline(parts, part, '|');)
    if (std::none_of(part.begin(), part.end(), [](char letter) { return letter >= 'A' && letter <= 'Z'; }))
      values.push_back(part);
  return values;
}

/// Is it a path, which bash completes by itself?
bool is_path(const std::string& expects) {
  return expects == "FILE" || expects == "FOLDER" || expects == "PROJECT" || expects == "CONTAINER";
}

/// "measure --semantics|search --semantics", for a case of bash.
std::string pattern_of(const std::string& command, const OptionOfCommand& option) {
  std::string pattern;
  for (const std::string& name : option.names)
    pattern.append(pattern.empty() ? "" : "|").append("\"" + command + " " + name + "\"");
  return pattern;
}

/// What may follow an option: the names of its values, files, or nothing that is known.
std::string value_cases(const Program& program, const std::string& command) {
  std::string cases;
  for (const OptionOfCommand& option : program.options(command)) {
    if (option.expects.empty() || is_path(option.expects)) continue;
    const std::string values = joined(named_values(option.expects), " ");
    cases += "    " + pattern_of(command, option) + ") _stackabilize_words \"" + values + "\"; return ;;\n";
  }
  return cases;
}

std::string option_case(const Program& program, const std::string& command) {
  std::vector<std::string> names;
  for (const OptionOfCommand& option : program.options(command))
    names.insert(names.end(), option.names.begin(), option.names.end());
  return "    " + command + ") _stackabilize_words \"" + joined(names, " ") + "\" ;;\n";
}

}  // namespace

std::string completion_script(const Program& program) {
  const std::vector<std::string> commands = program.command_names();
  std::string values, options;
  for (const std::string& command : commands) {
    values += value_cases(program, command);
    options += option_case(program, command);
  }
  return R"(# Completion of stackabilize for bash, made by stackabilize --completion.
_stackabilize_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word")
}

_stackabilize() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _stackabilize_words ")" +
         joined(commands, " ") + R"( --help --version --completion"
    return
  fi
  case "$command $before" in
)" + values +
         R"(  esac
  if [[ $word == -* ]]; then
    case $command in
)" + options +
         R"(    esac
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}

complete -o filenames -F _stackabilize stackabilize
)";
}

}  // namespace stackabilization::apps
