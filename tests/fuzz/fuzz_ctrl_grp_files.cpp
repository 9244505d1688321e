#include <cstdint>
#include <string_view>

#include "stackabilization/core/errors.h"
#include "structure/project/ctrl_grp_text.h"

using namespace stackabilization;

/// The same bytes as primitives and as relations.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const bool controls : {true, false}) try {
      const detail::CtrlGrpFrame frame{Eigen::Vector3d::Zero(), 1};
      if (controls)
        detail::parse_ctrl({text, "fuzz"}, {"a", "b"}, frame);
      else
        detail::parse_grp({text, "fuzz"}, {"a", "b"}, frame);
    } catch (const InputError&) {
    }
  return 0;
}
