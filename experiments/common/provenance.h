#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stackabilization::experiments {

/// Where numbers come from: every output of an experiment begins with it.
struct Provenance {
  std::string program;
  std::vector<std::string> arguments;
  int threads = 1;
};

/// Comment lines "# key: value" with program, arguments, threads, processor, compiler, library version and
/// revision.
std::string provenance_lines(const Provenance& provenance);

/// FNV-1a 64-bit hash of a file's bytes, 16 hexadecimal digits. Throws InputError when it cannot be read.
std::string file_hash(const std::filesystem::path& path);

/// Seconds on a steady clock.
double now();

/// Middle value; the lower one of two. Precondition: not empty.
double median(std::vector<double> values);

}  // namespace stackabilization::experiments
