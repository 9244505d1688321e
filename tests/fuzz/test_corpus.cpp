// What fuzzing found, and damaged seeds, through the fuzz targets, without libFuzzer.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "fuzz/seeds.h"
#include "fuzz/targets.h"
#include "support/catch.h"
#include "support/variants.h"

using namespace stackabilization;
namespace fs = std::filesystem;

namespace {

const fs::path corpus = fs::path(STACKABILIZATION_SOURCE_DIR) / "tests/fuzz/corpus";

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Runs on a copy of the very size, so that sanitizers see every read beyond it.
void run(const fuzz::Target& target, const std::string& bytes) {
  const std::vector<std::uint8_t> copy(bytes.begin(), bytes.end());
  CHECK(target.run(copy.data(), copy.size()) == 0);
}

/// Cut, or with some bytes replaced, removed or repeated.
std::string damaged(std::string bytes, solids::Random& random) {
  const std::size_t kind = random.below(4), at = random.below(bytes.size());
  if (kind == 0) return bytes.substr(0, at);
  if (kind == 1) return bytes.erase(at, 1 + random.below(8));
  if (kind == 2) return bytes.insert(at, bytes.substr(random.below(bytes.size()), 1 + random.below(40)));
  for (std::size_t k = random.below(4) + 1; k > 0; --k)
    bytes[random.below(bytes.size())] = static_cast<char>(random.below(256));
  return bytes;
}

}  // namespace

TEST_CASE("inputs that once were taken badly are read or refused in words") {
  std::set<std::string> folders;
  if (fs::exists(corpus))
    for (const auto& entry : fs::directory_iterator(corpus)) folders.insert(entry.path().filename().string());
  for (const fuzz::Target& target : fuzz::targets()) {
    if (folders.erase(target.name) == 0) continue;
    for (const auto& entry : fs::directory_iterator(corpus / target.name)) {
      INFO(entry.path().string());
      CHECK(entry.file_size() < 10'000);
      run(target, bytes_of(entry.path()));
    }
  }
  CHECK(folders.empty());  // every folder is that of a target
}

TEST_CASE("every target takes its seeds, and what little damage makes of them") {
  const std::vector<fuzz::Seed> seeds = fuzz::seeds();
  for (const fuzz::Target& target : fuzz::targets()) {
    int count = 0;
    solids::Random random(7);
    run(target, "");
    for (const fuzz::Seed& seed : seeds) {
      if (seed.target != target.name) continue;
      INFO(target.name << "/" << seed.name);
      run(target, seed.bytes);
      for (int round = 0; round < 200; ++round) run(target, damaged(seed.bytes, random));
      ++count;
    }
    CHECK(count > 0);
  }
}
