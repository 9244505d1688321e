#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "improvement/design/configuration_key.h"
#include "improvement/search/interruption.h"
#include "improvement/search/search_tree.h"

namespace stackabilization::detail {

/// Result of one suggested edit.
struct SuccessorNode {
  ContactEdit suggestion;
  std::optional<Obstacle> refusal;  ///< if set, the fields below are meaningless
  bool known = false;  ///< whether its configuration is in the visited set; if so, only `key` is set
  std::uint64_t key = 0;
  Stackability measured;
  Energy energy;
  Design design;
};

/// Everything needed to make and measure the candidates of a search.
struct SearchTools {
  const RequirementChecker& checker;
  const BestFirstOptions& options;
  EnergyMeter meter;
  ConfigurationKeys keys;
  std::vector<Handle> handles;
  std::vector<Eigen::Vector3d> centres;  ///< of the handles, at rest
  double at_rest = 0;                    ///< S(M0) along the first starting direction

  SearchTools(const RequirementChecker& checker, const BestFirstOptions& options);

  Energy energy(const Design& design, const Stackability& measured) const {
    return meter.energy(design, measured.value - at_rest);
  }
};

/// Expanded node: its design, its direction and its queue.
struct ExpandedNode {
  const Design& design;
  Eigen::Vector3d direction;
  int queue = 0;
};

/// Returns whether `edit` undoes `earlier`, at least in part: the same operation (a move, leaning, scaling or
/// taper) on the same handle, the other way. Edits that differ otherwise, as in the axis, undo nothing.
bool takes_back(const Edit& edit, const Edit& earlier);

/// Returns the edits that the contacts of the node suggest, without those that undo an earlier edit of the
/// node (`takes_back`).
std::vector<ContactEdit> suggested_edits(const SearchTools& tools, const ExpandedNode& from);

/// Makes and measures the successors of the node, one per edit, in order. Successors whose configuration is
/// in the visited set of the queue are not measured. Runs in parallel, each in its own slot. After an
/// interruption some are missing: ask `interruption`.
std::vector<SuccessorNode> successors(const SearchTools& tools, const ExpandedNode& from,
                                      std::vector<ContactEdit> edits, const SearchTree& tree,
                                      Interruption& interruption);

}  // namespace stackabilization::detail
