#include "paper_figures/figure.h"

namespace stackabilization::figures {

std::vector<Figure> all_figures() {
  return {figure_02(), figure_03(), figure_04(), figure_05(), figure_07(), figure_13()};
}

}  // namespace stackabilization::figures
