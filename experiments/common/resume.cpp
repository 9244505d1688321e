#include "common/resume.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "common/hash.h"
#include "common/json.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/write_file.h"

namespace stackabilization::experiments {
namespace {

namespace fs = std::filesystem;

fs::path record_path(const Job& job, const fs::path& folder) {
  return folder / (job.name + ".done");
}

/// Tables and plots of the job, by name; neither its record nor its log.
std::vector<fs::path> outputs(const Job& job, const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (is_output_of(job.name, it->path().filename().string())) files.push_back(it->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Json hashes(const Job& job, const fs::path& folder) {
  Json result = Json::object();
  for (const fs::path& file : outputs(job, folder)) result[file.filename().string()] = file_hash(file);
  return result;
}

}  // namespace

bool is_output_of(const std::string& program, const std::string& name) {
  const std::string ending = fs::path(name).extension().string();
  return (name.starts_with(program + ".") || name.starts_with(program + "_")) &&
         (ending == ".csv" || ending == ".json" || ending == ".svg" || ending == ".png");
}

std::string fingerprint(const Job& job) {
  std::string text = job.name + "\n" + file_hash(job.program) + "\n";
  for (const std::string& argument : job.arguments) text += argument + "\n";
  for (const fs::path& input : job.inputs) text += input.filename().string() + " " + file_hash(input) + "\n";
  return text_hash(text);
}

std::optional<int> completed(const Job& job, const fs::path& folder) {
  std::ifstream file(record_path(job, folder));
  if (!file) return std::nullopt;
  const Json record = Json::parse(file, nullptr, false);
  if (!record.is_object() || record.value("fingerprint", "") != fingerprint(job)) return std::nullopt;
  const Json recorded = record.value("outputs", Json::object());
  if (recorded.empty() || recorded != hashes(job, folder)) return std::nullopt;
  return record.value("status", 0);
}

void record_completed(const Job& job, int status, const fs::path& folder) {
  const Json record = {
      {"fingerprint", fingerprint(job)}, {"status", status}, {"outputs", hashes(job, folder)}};
  write_file_atomically(record_path(job, folder), record.dump(1) + "\n");
}

void clear(const Job& job, const fs::path& folder) {
  std::error_code ignored;
  fs::remove(record_path(job, folder), ignored);
  for (const fs::path& file : outputs(job, folder)) fs::remove(file, ignored);
}

}  // namespace stackabilization::experiments
