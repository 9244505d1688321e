#include "paper_figures/gallery.h"

namespace stackabilization::figures {

Figure figure_10() {
  return gallery_figure(10, "Eight pieces of furniture before and after");
}

}  // namespace stackabilization::figures
