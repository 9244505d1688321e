#include "paper_figures/figure.h"

namespace stackabilization::figures {

std::vector<Figure> all_figures() {
  return {figure_02(), figure_07()};
}

}  // namespace stackabilization::figures
