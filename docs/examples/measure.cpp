// Prints how well the shape of a mesh file stacks along z.
#include <stackabilization/core/errors.h>
#include <stackabilization/io/read.h>
#include <stackabilization/stacking/stackability.h>

#include <iostream>

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "expected the name of a mesh file\n";
    return 2;
  }
  try {
    const auto result = stackabilization::stackability(stackabilization::read_shape(arguments[1]), {0, 0, 1});
    std::cout << "f_max = " << result.f_max << " of " << result.extent << ", S = " << result.value << '\n';
  } catch (const stackabilization::InputError& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
