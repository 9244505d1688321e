// Changes the shape of a mesh file until it stacks as asked for, and writes the design.
#include <stackabilization/core/errors.h>
#include <stackabilization/improvement/task.h>
#include <stackabilization/io/read.h>
#include <stackabilization/io/write.h>
#include <stackabilization/structure/analysis.h>

#include <cstdlib>
#include <iostream>

using namespace stackabilization;

int main(int count, char** arguments) {
  if (count != 4) {
    std::cerr << "expected a mesh file, a target for S and the file of the design\n";
    return 2;
  }
  try {
    Requirements wish;
    wish.target = std::strtod(arguments[2], nullptr);
    wish.quality.emplace();  // no change that a person would mind, see docs/quality.md
    const ImprovementTask task(analyse_structure(read_shape(arguments[1])), wish);
    const Improvement found = improve(task);
    if (found.solutions.empty()) {
      if (found.diagnosis) std::cout << text(*found.diagnosis, task.rest().structure);
      return 1;
    }
    const Candidate& best = found.solutions.front();
    write_shape(best.design.shape, arguments[3]);
    std::cout << "S = " << best.measured.value << " with " << best.design.edits.size()
              << " edits, D = " << best.energy.distortion.total() << '\n';
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
