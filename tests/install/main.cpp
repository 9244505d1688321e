#include <iostream>
#include <stackabilization/stacking/stackability.h>

int main() {
  const stackabilization::Points corners{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const stackabilization::Triangles faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  std::cout << "f_max = " << stackabilization::stackability(stackabilization::make_shape(corners, faces), {0, 0, 1}).f_max << '\n';
}
