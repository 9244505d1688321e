#include "apps/common/design_json.h"

namespace stackabilization::apps {

const char* name_of(ContactType type) {
  switch (type) {
    case ContactType::dot:
      return "dot";
    case ContactType::line:
      return "line";
    case ContactType::ring:
      return "ring";
  }
  return "";
}

Json to_json(const Energy& energy, double alpha) {
  const Distortion& distortion = energy.distortion;
  return {{"value", energy.value},
          {"alpha", alpha},
          {"gain", energy.gain},
          {"distortion",
           {{"total", distortion.total()},
            {"volume", distortion.volume},
            {"proximity", distortion.proximity},
            {"box", distortion.box},
            {"symmetry", distortion.symmetry}}}};
}

}  // namespace stackabilization::apps
