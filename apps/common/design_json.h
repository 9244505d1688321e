#pragma once

#include "apps/common/json.h"
#include "stackabilization/improvement/energy.h"

namespace stackabilization::apps {

/// "dot", "line" or "ring"
const char* name_of(ContactType type);

/// {value, alpha, gain, distortion: {total, volume, proximity, box, symmetry}}
Json to_json(const Energy& energy, double alpha);

}  // namespace stackabilization::apps
