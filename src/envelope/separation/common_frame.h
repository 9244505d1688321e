#pragma once

#include <array>

#include "envelope/separation/separation_tree.h"

namespace stackabilization::detail {

/// Two trees in one frame: as they are if their origins agree, else built again in the file's axes.
class CommonFrame {
 public:
  CommonFrame(const SeparationTree& below, const SeparationTree& above)
      : below_(&below.data()), above_(&above.data()) {
    if (below_->origin == above_->origin) return;
    rebuilt_ = {below_->in_file_axes(), above_->in_file_axes()};
    below_ = &rebuilt_[0];
    above_ = &rebuilt_[1];
  }
  CommonFrame(const CommonFrame&) = delete;
  CommonFrame& operator=(const CommonFrame&) = delete;

  const SeparationTree::Data& below() const { return *below_; }
  const SeparationTree::Data& above() const { return *above_; }

 private:
  const SeparationTree::Data* below_;
  const SeparationTree::Data* above_;
  std::array<SeparationTree::Data, 2> rebuilt_;
};

}  // namespace stackabilization::detail
