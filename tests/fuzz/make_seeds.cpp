// Writes a seed corpus for every fuzz target: make_fuzz_seeds FOLDER.
#include <filesystem>
#include <iostream>

#include "fuzz/seeds.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/write_file.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make_fuzz_seeds FOLDER\n";
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    for (const stackabilization::fuzz::Seed& seed : stackabilization::fuzz::seeds()) {
      std::filesystem::create_directories(folder / seed.target);
      stackabilization::write_file_atomically(folder / seed.target / seed.name, seed.bytes);
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
