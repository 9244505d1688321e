#include <stackabilization/shape/read.h>
#include <stackabilization/stacking/stackability.h>

#include <iostream>

int main(int, char** arguments) {
  const stackabilization::Shape shape = stackabilization::read_shape(arguments[1]);
  std::cout << "f_max = " << stackabilization::stackability(shape, {0, 0, 1}).f_max << '\n';
}
