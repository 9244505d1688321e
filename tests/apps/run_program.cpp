#include "apps/run_program.h"

#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <future>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "stackabilization/io/write.h"
#include "support/catch.h"

namespace stackabilization::apps {

namespace {

std::string quoted(const std::string& argument) {
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

Arguments joined(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const std::vector<std::string>& command_names() {
  static const std::vector<std::string> names = {"inspect",  "measure",   "search", "map",     "stack",
                                                 "hold",     "gap",       "drop",   "items",   "draft",
                                                 "validate", "structure", "deform", "suggest", "improve"};
  return names;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "stackabilize-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::file(const std::string& name, const std::string& bytes) const {
  std::ofstream(path_ / name, std::ios::binary) << bytes;
  return *this / name;
}

std::string TemporaryFolder::model(const std::string& name, const Shape& shape) const {
  write_shape(shape, path_ / name);
  return *this / name;
}

std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

Eigen::Vector3d vector_of(const nlohmann::json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

Outcome run_program(const Arguments& arguments, const std::string& input, const std::string& prefix) {
  const TemporaryFolder folder;
  std::string command = prefix;
  command.append(" ").append(quoted(STACKABILIZATION_PROGRAM));
  for (const std::string& argument : arguments) command.append(" ").append(quoted(argument));
  command.append(" <").append(quoted(folder.file("in", input)));
  command.append(" >").append(quoted(folder / "out"));
  command.append(" 2>").append(quoted(folder / "err"));
  const int status = std::system(command.c_str());
  Outcome outcome;
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = bytes_of(folder / "out");
  outcome.err = bytes_of(folder / "err");
  return outcome;
}

Outcome run_and_signal(const Arguments& arguments, int signal, const std::function<bool(pid_t)>& ready) {
  using namespace std::chrono_literals;
  const TemporaryFolder folder;
  const std::string number = folder / "process";
  // The shell writes down its number and becomes the program.
  const std::string prefix = "echo $$ >" + quoted(number) + "; exec";
  std::future<Outcome> outcome =
      std::async(std::launch::async, [&] { return run_program(arguments, "", prefix); });
  pid_t process = 0;
  const auto is_ready = [&] {
    if (process == 0 && bytes_of(number).ends_with('\n')) process = std::stoi(bytes_of(number));
    return process != 0 && ready(process);
  };
  const auto limit = std::chrono::steady_clock::now() + 5min;
  bool is_late = false;
  while (!is_late && !is_ready()) {
    if (outcome.wait_for(10ms) == std::future_status::ready)
      FAIL("the program ended early: " << outcome.get().err);
    is_late = std::chrono::steady_clock::now() > limit;
  }
  if (process != 0) kill(process, is_late ? SIGKILL : signal);
  Outcome result = outcome.get();
  if (is_late) FAIL("the program is not ready for a signal: " << result.err);
  return result;
}

double processor_seconds(pid_t process) {
  const std::string text = bytes_of("/proc/" + std::to_string(process) + "/stat");
  // After the name in parentheses: state, ten numbers, then the ticks in user and in system mode.
  std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
  std::string skipped;
  for (int k = 0; k < 11; ++k) fields >> skipped;
  double user = 0, system = 0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

bool is_one_sentence(const std::string& text) {
  constexpr std::size_t shortest = 30;
  return text.starts_with("stackabilize: ") && text.ends_with('\n') &&
         std::count(text.begin(), text.end(), '\n') == 1 && text.size() > shortest;
}

void check_refused(const TemporaryFolder& folder, const Arguments& arguments, int status,
                   const std::string& words) {
  std::string line = "stackabilize";
  for (const std::string& argument : arguments) line += " " + argument;
  INFO(line);
  const std::vector<std::string> before = folder.names();
  const Outcome outcome = run_program(arguments);
  INFO(outcome.err);
  CHECK(outcome.status == status);
  CHECK(outcome.out.empty());
  CHECK(is_one_sentence(outcome.err));
  CHECK(outcome.err.find(words) != std::string::npos);
  CHECK(folder.names() == before);
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files[entry.path().filename().string()] = bytes_of(entry.path().string());
  return files;
}

}  // namespace stackabilization::apps
