#include <exception>
#include <filesystem>
#include <iostream>

#include "generator/models.h"
#include "stackabilization/io/write.h"

/// Writes every shipped model as FOLDER/NAME.obj.
int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: " << arguments[0] << " FOLDER\n";
    return 2;
  }
  try {
    const std::filesystem::path folder = arguments[1];
    std::filesystem::create_directories(folder);
    for (const auto& [name, shape] : stackabilization::models::all_models())
      stackabilization::write_shape(shape, folder / (name + ".obj"));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
