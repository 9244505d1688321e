#include "apps/common/owned_folder.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/common/output.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/fingerprint.h"
#include "stackabilization/core/text.h"
#include "stackabilization/io/read_file.h"
#include "stackabilization/io/write_file.h"

namespace stackabilization::apps {

namespace {

namespace fs = std::filesystem;
using SortedJson = nlohmann::json;

constexpr const char* list_name = "stackabilize-files.json";
constexpr const char* format_name = "stackabilization files";

[[noreturn]] void refuse_file(const fs::path& file, const std::string& reason) {
  throw OutputError(file.string() + " is in the way: " + reason + "; take it away, or choose another folder");
}

/// Hexadecimal; empty for a file that cannot be read.
std::string hash_of(const fs::path& file) {
  Fingerprint hash;
  try {
    hash.add(read_file(file));
  } catch (const InputError&) {
    return "";
  }
  std::array<char, 16> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), hash.value(), 16);
  return {digits.data(), end};
}

}  // namespace

OwnedFolder::OwnedFolder(fs::path path, NameTest is_name, FileTest is_known)
    : path_(std::move(path)), is_name_(std::move(is_name)), is_known_(std::move(is_known)) {}

bool OwnedFolder::is_written(const std::string& name) const {
  return name == list_name || is_name_(name);
}

OwnedFolder::List OwnedFolder::list() const {
  const fs::path file = path_ / list_name;
  std::error_code error;
  if (!fs::exists(file, error)) return {};
  const SortedJson text = SortedJson::parse(read_file(file), nullptr, false);
  if (!text.is_object() || text.value("format", SortedJson()) != format_name || !text.contains("files") ||
      !text.at("files").is_object())
    refuse_file(file, "it is no list of files that this program wrote");
  List list;
  for (const auto& [name, hash] : text.at("files").items())
    list[name] = hash.is_string() ? std::optional(hash.get<std::string>()) : std::nullopt;
  return list;
}

void OwnedFolder::write(const List& list) const {
  SortedJson files = SortedJson::object();
  for (const auto& [name, hash] : list) files[name] = hash ? SortedJson(*hash) : SortedJson(nullptr);
  const SortedJson text = {{"format", format_name}, {"files", std::move(files)}};
  write_output((path_ / list_name).string(), text.dump(1) + "\n");
}

void OwnedFolder::check() const {
  const List listed = list();
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path_, error)) {
    // Some file systems take a name in capitals for the same.
    const std::string name = entry.path().filename().string(), lower = lower_case(name);
    if (is_name_(name) || (is_name_(lower) && fs::equivalent(entry.path(), path_ / lower, error)))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    if (is_known_ && is_known_(file)) continue;
    const auto found = listed.find(file.filename().string());
    if (found == listed.end()) refuse_file(file, "this program did not write it there");
    if (found->second && *found->second != hash_of(file))
      refuse_file(file, "it was changed since this program wrote it");
  }
}

void OwnedFolder::make() const {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw OutputError(path_.string() + " cannot be made: " + error.message());
}

void OwnedFolder::begin(const std::vector<std::string>& names) const {
  make();
  check();
  List listed = list();
  for (const std::string& name : names) listed[name] = std::nullopt;
  write(listed);
}

void OwnedFolder::remove(const std::string& name) const {
  std::error_code error;
  const fs::path file = path_ / name;
  if (list().contains(name) || (is_known_ && is_known_(file))) fs::remove(file, error);
}

void OwnedFolder::remove_others(const std::vector<std::string>& kept) const {
  std::error_code error;
  std::vector<fs::path> left;
  for (const auto& [name, hash] : list())
    if (is_name_(name) && std::find(kept.begin(), kept.end(), name) == kept.end())
      left.push_back(path_ / name);
  for (const auto& entry : fs::directory_iterator(path_, error)) {
    const std::optional<std::string> target = target_of_temporary(entry.path().filename().string());
    if (target && is_written(*target) && entry.is_regular_file(error)) left.push_back(entry.path());
  }
  for (const fs::path& file : left) fs::remove(file, error);
}

void OwnedFolder::finish(const std::vector<std::string>& written) const {
  List listed = list();
  std::erase_if(listed, [this](const auto& entry) { return is_name_(entry.first); });
  for (const std::string& name : written) listed[name] = hash_of(path_ / name);
  write(listed);
}

}  // namespace stackabilization::apps
