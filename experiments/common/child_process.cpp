#include "common/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <fstream>

#include "common/clock.h"
#include "stackabilization/core/errors.h"

namespace stackabilization::experiments {

namespace {

constexpr int status_not_started = 127, status_of_signal = 128;

double seconds_of(const timeval& time) {
  constexpr double microsecond = 1e-6;
  return static_cast<double>(time.tv_sec) + microsecond * static_cast<double>(time.tv_usec);
}

/// After the fork nothing may be allocated: other threads of the parent are gone with whatever they held.
[[noreturn]] void become(char** argv, const char* log, int max_processor_seconds) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (max_processor_seconds > 0) {
    const auto limit = static_cast<rlim_t>(max_processor_seconds);
    const rlimit processor{limit, limit + 1};  // SIGXCPU first, SIGKILL a second later
    setrlimit(RLIMIT_CPU, &processor);
  }
  const int file = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0 || dup2(file, STDOUT_FILENO) < 0 || dup2(file, STDERR_FILENO) < 0) _exit(status_not_started);
  execv(argv[0], argv);
  _exit(status_not_started);
}

}  // namespace

ChildOutcome run_child(const ChildProcess& child) {
  std::vector<std::string> words = child.words;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::string log = child.log.string();
  const double start = now();
  const pid_t process = fork();
  if (process < 0) throw OutputError(words.front() + ": no new process can be made");
  if (process == 0) become(argv.data(), log.c_str(), child.max_processor_seconds);
  int status = 0;
  rusage used = {};
  while (wait4(process, &status, 0, &used) < 0 && errno == EINTR) {
  }
  constexpr double megabytes_per_kibibyte = 1024e-6;
  ChildOutcome outcome;
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : status_of_signal + WTERMSIG(status);
  outcome.seconds = now() - start;
  outcome.processor_seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  outcome.megabytes = megabytes_per_kibibyte * static_cast<double>(used.ru_maxrss);
  return outcome;
}

std::string first_line(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

}  // namespace stackabilization::experiments
