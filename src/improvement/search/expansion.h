#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "improvement/design/configuration_key.h"
#include "improvement/search/interruption.h"
#include "improvement/search/search_tree.h"

namespace stackabilization::detail {

/// What became of one suggestion.
struct Successor {
  ContactEdit suggestion;
  std::optional<std::string> refusal;  ///< nothing below is set then
  bool known = false;                  ///< its configuration was met before: nothing below but the key is set
  std::uint64_t key = 0;
  Stackability measured;
  Energy energy;
  Design design;
};

/// What every candidate of a search is made and measured with.
struct SearchTools {
  const RequirementChecker& checker;
  const BestFirstOptions& options;
  EnergyMeter meter;
  ConfigurationKeys keys;
  std::vector<Handle> handles;
  double at_rest = 0;  ///< S(M0), along the first direction

  SearchTools(const RequirementChecker& checker, const BestFirstOptions& options);

  Energy energy(const Design& design, const Stackability& measured) const {
    return meter.energy(design, measured.value - at_rest);
  }
};

/// A candidate that is taken: its design, and along which direction and in which queue it goes on.
struct Standpoint {
  const Design& design;
  Eigen::Vector3d direction;
  int queue = 0;
};

/// What its contacts suggest, but for edits that take back earlier ones.
std::vector<ContactEdit> suggested_edits(const SearchTools& tools, const Standpoint& from);

/// Its successors by these edits, in their order; those whose configuration is known in the queue are only
/// named. Made in parallel, each in its own slot. When interrupted, some are missing: look at `interruption`.
std::vector<Successor> successors(const SearchTools& tools, const Standpoint& from,
                                  std::vector<ContactEdit> edits, const SearchTree& tree,
                                  Interruption& interruption);

}  // namespace stackabilization::detail
