#include "apps/editor/session_locks.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "stackabilization/core/errors.h"

namespace stackabilization::apps {

namespace {

/// A file that is locked as long as this object lives, and then removed.
class LockedFile {
 public:
  /// Throws UsageError where another program has locked it.
  LockedFile(std::filesystem::path path, const std::string& session) : path_(std::move(path)) {
    do {
      close_file();
      file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR);
      if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) != 0) {
        const bool taken = errno == EWOULDBLOCK;
        close_file();
        if (taken) throw UsageError("another program edits " + session + ": close it first");
      }
    } while (file_ >= 0 && was_removed());
  }
  ~LockedFile() {
    if (file_ >= 0) unlink(path_.c_str());
    close_file();
  }
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

 private:
  /// Did the program that had it before remove it, after it was opened here?
  bool was_removed() const {
    struct stat own {
    }, named{};
    if (fstat(file_, &own) != 0 || stat(path_.c_str(), &named) != 0) return true;
    return own.st_ino != named.st_ino || own.st_dev != named.st_dev;
  }
  void close_file() {
    if (file_ >= 0) close(file_);
    file_ = -1;
  }

  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace

SessionLock SessionLocks::take(const std::filesystem::path& file) {
  if (file.empty()) return nullptr;
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(file, error);
  const std::filesystem::path& place = error ? file : whole;
  if (SessionLock known = taken_[place].lock()) return known;
  auto lock = std::make_shared<const LockedFile>(place.string() + ".lock", file.string());
  taken_[place] = lock;
  return lock;
}

}  // namespace stackabilization::apps
