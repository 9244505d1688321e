#pragma once

#include "apps/improve/improve_report.h"
#include "stackabilization/improvement/history.h"

namespace stackabilization::apps {

/// The shape at rest with a history in which every solution is a branch of its own, the best one current, so
/// that `suggest` goes on from there. Left out are those that their edits do not make again in one go under
/// the constraints of their direction, because the search turned that on the way.
Project improvement_project(const ImproveReport& report);

}  // namespace stackabilization::apps
