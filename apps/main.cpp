#include <string>
#include <vector>

#include "apps/common/interrupt.h"
#include "apps/common/program.h"

int main(int argc, char** argv) {
  using namespace stackabilization::apps;
  install_interrupt_handler();
  char** const first = argc > 0 ? argv + 1 : argv;  // a program may be started without its own name
  return guarded([&] { return Program().parse_and_run(std::vector<std::string>(first, argv + argc)); });
}
