#pragma once

#include <compare>
#include <string>
#include <vector>

#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization::detail {

/// Signature of an edit: its handle and its kind of operation, without amounts. Equal for parts that
/// symmetries connect.
struct EditSignature {
  int part_class = 0;
  int handle_kind = 0, index = 0;
  int operation = 0;  ///< index of the alternative of Operation
  /// Rounded direction of a move or axis of a rotation; for a scaling x = 1 up, x = -1 down.
  int x = 0, y = 0, z = 0;
  int falloff = 0;

  auto operator<=>(const EditSignature&) const = default;
};

/// Decides whether two solutions are different.
class SolutionDiversity {
 public:
  explicit SolutionDiversity(const StructuredShape& rest);

  /// Returns the signatures of the edits, sorted, without duplicates.
  std::vector<EditSignature> signatures(const std::vector<Edit>& edits) const;
  /// Returns whether two designs are different, as documented at `best_first`.
  bool differ(const Design& a, const Design& b) const;

 private:
  EditSignature signature(const Edit& edit) const;

  const StructuredShape& rest_;
  std::vector<int> part_class_;
};

}  // namespace stackabilization::detail
