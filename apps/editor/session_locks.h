#pragma once

#include <filesystem>
#include <map>
#include <memory>

namespace stackabilization::apps {

/// Keeps a file of a session for this program as long as a copy of it is there; null: no file.
using SessionLock = std::shared_ptr<const void>;

/// The files of sessions that this program has for itself: of two programs that save one session, each would
/// overwrite what the other one has saved.
class SessionLocks {
 public:
  /// Takes a file, which need not exist; a file that this program has already is shared. FILE.lock beside it
  /// is what other programs see, until the lock is gone or the program is killed. Where that cannot be
  /// written, there is no lock, as nothing can be saved there either. Throws UsageError where another program
  /// has the file.
  SessionLock take(const std::filesystem::path& file);

 private:
  std::map<std::filesystem::path, std::weak_ptr<const void>> taken_;
};

}  // namespace stackabilization::apps
