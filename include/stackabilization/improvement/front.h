#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "stackabilization/improvement/task.h"

namespace stackabilization {

/// A design of the front: the one of least change found that reaches a target.
struct FrontPoint {
  double target = 0;      ///< S asked for; that at rest for the first point
  Candidate candidate;    ///< the design; the shape at rest for the first point
  Assessment assessment;  ///< checks against the requirements with this target
  double change = 0;      ///< size of the change, see change_measure.h; 0 at rest
};

/// A target for fronts that go as far as they can: more than objects of use reach.
inline constexpr double farthest_target = 0.95;
/// An effort for each target of a front, see effort.h: its designs start from each other.
inline constexpr double front_effort = 0.3;

/// Options of `improvement_front`.
struct FrontOptions {
  int points = 8;  ///< number of designs, the shape at rest included; >= 2
  /// Largest number of further targets tried between what was reached and what was missed, >= 0.
  int bisections = 4;
  /// Options of each run of `improve`. The effort is that of one target. Without `save`.
  ImprovementOptions improvement;
  /// Called before each run of `improve` with its number, from 0, and the largest number of runs.
  std::function<void(int run, int runs)> progress = {};
  /// Called from the calling thread with each design that reaches its target, as soon as it is found. Some
  /// are no part of the front in the end.
  std::function<void(const Candidate&)> found = {};
};

/// The trade of S against change.
struct Front {
  /// The shape at rest, then designs by target, ascending: equally spaced from S at rest to the largest S
  /// reached. Every design meets the requirements; neither S nor change ever decreases. The shape at rest
  /// alone if no larger S was reached.
  std::vector<FrontPoint> points;
  bool reached = false;  ///< whether the target of the requirements was reached
  /// Why it was not: the diagnosis of the smallest target that was missed, with the largest S of all designs.
  std::optional<Diagnosis> diagnosis;
  std::optional<Candidate> nearest;   ///< what came nearest to it, without a limit of the form
  std::int64_t evaluated = 0;         ///< designs measured by all runs
  SearchEnd end = SearchEnd::solved;  ///< `cancelled` if the caller cancelled, `time_limit` at a deadline
};

/// Finds designs of least change for targets from S at rest to the target of the requirements, or to the
/// largest S that is reached. Each is the best solution of `improve` for its target, which starts also from
/// the design of the next larger target; where that target is missed, bisection looks for the largest one
/// that is reached. So each design changes the shape by no more than that of the next larger target. S at
/// rest is that along the first starting direction. Deterministic for any number of threads, unless a
/// deadline ends a run. Throws UsageError for fewer than 2 points, for requirements with a length limit, for
/// the paper's preset, and as `improve`.
Front improvement_front(const RequirementChecker& checker, const FrontOptions& options = {});

/// Finds the front of a task, from its starting directions; those of `options` are ignored. Otherwise as
/// above.
Front improvement_front(const ImprovementTask& task, FrontOptions options = {});

}  // namespace stackabilization
