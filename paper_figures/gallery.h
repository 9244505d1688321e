#pragma once

#include <string>

#include "paper_figures/figure.h"

namespace stackabilization::figures {

/// A figure of several objects before and after, a stack each (Fig. 9 and 10).
Figure gallery_figure(int number, std::string title);

}  // namespace stackabilization::figures
