#pragma once

#include <string>

#include "apps/improve/improve_report.h"

namespace stackabilization::apps {

/// One HTML page that shows the solutions side by side, with everything in it but the pictures, which are
/// referred to by their names. Also well-formed as XML.
std::string improvement_page(const ImproveReport& report);

}  // namespace stackabilization::apps
