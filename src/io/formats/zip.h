#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stackabilization/core/text.h"

namespace stackabilization {

/// A zip archive in memory.
class ZipReader {
 public:
  /// Throws InputError unless the bytes are a zip archive. The bytes must outlive this object.
  explicit ZipReader(const Source& source);
  ~ZipReader();

  /// Returns the content of the entry of this name, in upper or lower case, or nothing when there is none.
  /// Throws InputError when the entry is damaged or inflates beyond the limit.
  std::optional<std::string> entry(const std::string& name) const;

 private:
  struct Archive;
  std::unique_ptr<Archive> archive_;
};

/// Returns a zip archive of (name, content) entries. All entries are dated 1980-01-01, so that the same
/// content gives the same bytes.
std::string zip(const std::vector<std::pair<std::string, std::string>>& entries);

}  // namespace stackabilization
