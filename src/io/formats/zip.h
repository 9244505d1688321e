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
  /// Throws InputError unless the bytes are a zip archive. They must outlive the reader.
  explicit ZipReader(const Source& source);
  ~ZipReader();

  /// Content of the entry of this name, in either case, or nothing when there is none. Throws InputError when
  /// it is damaged, or inflates to more than any mesh would.
  std::optional<std::string> entry(const std::string& name) const;

 private:
  struct Archive;
  std::unique_ptr<Archive> archive_;
};

/// Zip archive of (name, content) entries, all dated 1980-01-01 so that the same content gives the same
/// bytes.
std::string zip(const std::vector<std::pair<std::string, std::string>>& entries);

}  // namespace stackabilization
