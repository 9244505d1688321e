#include "paper_figures/gallery.h"

namespace stackabilization::figures {

Figure figure_09() {
  return gallery_figure(9, "Five containers before and after");
}

}  // namespace stackabilization::figures
