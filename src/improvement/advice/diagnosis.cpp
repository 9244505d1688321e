#include "stackabilization/improvement/diagnosis.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "improvement/advice/edit_trials.h"
#include "improvement/contacts/contact_symmetry.h"
#include "stackabilization/improvement/partition.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/stacking/search.h"

namespace stackabilization {

namespace {

/// Least increase of S that counts as help.
constexpr double worth_saying = 0.01;
constexpr int max_blockers = 4;
constexpr std::size_t max_constraints = 3, max_removals = 3;
/// Largest portion of the surface that may be left out. Without more it would be another object.
constexpr double max_removed_area = 0.5;
/// Pieces of an object that is worth taking apart: a top and four legs.
constexpr std::size_t max_pieces = 5;

bool contains(const std::vector<int>& parts, int part) {
  return std::find(parts.begin(), parts.end(), part) != parts.end();
}

/// Rounds a number of directions down to a limit of at least 1.
std::int64_t whole_directions(double count) {
  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  if (!(count < static_cast<double>(most))) return most;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(count));
}

using detail::EditTrial;
using detail::EditTrials;

class DiagnosisBuilder {
 public:
  DiagnosisBuilder(const RequirementChecker& checker, const BestFirstResult& result,
                   const DiagnosisOptions& options)
      : checker_(checker),
        options_(options),
        refusals_(result.refusals),
        best_(result.nearest.front()),
        rest_(checker.space().rest()),
        direction_(best_.direction),
        trials_(checker.space(), best_, options),
        solver_(best_.design.shape, checker.requirements().measure) {}

  Diagnosis run() {
    diagnosis_.target = checker_.required_stackability(best_.measured);
    diagnosis_.reached = best_.measured.value;
    diagnosis_.direction = best_.direction;
    find_blockers();
    if (refusals_.empty())
      for (const auto& [obstacle, count] : tried_refusals_) refusals_.push_back({obstacle, count});
    diagnosis_.constraints = obstacles();
    if (diagnosis_.constraints.size() > max_constraints) diagnosis_.constraints.resize(max_constraints);
    if (!stopped()) free_parts();
    if (!stopped()) relax();
    if (!stopped()) remove_parts();
    if (!stopped()) take_apart();
    if (!stopped()) look_elsewhere();
    make_better();
    std::stable_sort(diagnosis_.remedies.begin(), diagnosis_.remedies.end(),
                     [](const Remedy& a, const Remedy& b) { return a.stackability > b.stackability; });
    return std::move(diagnosis_);
  }

 private:
  bool stopped() const { return trials_.stopped(); }

  bool helps(double stackability) const { return stackability > diagnosis_.reached + worth_saying; }

  /// Returns the obstacles of the search, or those of the edits of the best design where the search met none.
  /// Checks that stand against the best design alone, which reaches the target, come first: nothing else
  /// keeps it from being a solution.
  std::vector<ObstacleCount> obstacles() const {
    std::vector<ObstacleCount> all = told_once(refusals_);
    if (!checker_.meets_target(best_.measured)) return all;
    std::vector<ObstacleCount> own;
    for (const Check& check : checker_.check(best_.design, direction_).checks) {
      if (check.passed) continue;
      const Obstacle obstacle = Check{check.kind};
      const auto known = std::find_if(all.begin(), all.end(),
                                      [&](const ObstacleCount& other) { return other.obstacle == obstacle; });
      own.push_back(known == all.end() ? ObstacleCount{obstacle, 1} : *known);
      if (known != all.end()) all.erase(known);
    }
    all.insert(all.begin(), own.begin(), own.end());
    return all;
  }

  /// Adds up the counts of obstacles that read the same, such as two symmetries of one part, and sorts them.
  std::vector<ObstacleCount> told_once(const std::vector<ObstacleCount>& counts) const {
    std::map<std::string, std::size_t> rows;
    std::vector<ObstacleCount> result;
    for (const ObstacleCount& count : counts) {
      const auto [row, is_new] = rows.try_emplace(describe(count.obstacle, rest_.structure), result.size());
      if (is_new)
        result.push_back(count);
      else
        result[row->second].count += count.count;
    }
    sort_by_count(result, rest_.structure);
    return result;
  }

  void find_blockers() {
    const Separation separation = solver_.separation(direction_);
    if (!separation.blocked) return;
    ContactOptions contacts;
    contacts.semantics = checker_.requirements().measure.semantics;
    const std::vector<ContactRegion> all =
        contact_regions({best_.design.shape, solver_.tree(), direction_, separation}, contacts).regions;
    const detail::ContactSymmetry symmetry(rest_.structure);
    for (const int row : detail::different_regions(all, symmetry, max_blockers)) {
      regions_.push_back(all[static_cast<std::size_t>(row)]);
      diagnosis_.blockers.push_back(blocker(regions_.back()));
    }
    std::stable_sort(diagnosis_.blockers.begin(), diagnosis_.blockers.end(),
                     [](const Blocker& a, const Blocker& b) { return a.f > b.f; });
  }

  Blocker blocker(const ContactRegion& region) {
    Blocker blocker;
    blocker.upper_part = region.upper_part;
    blocker.lower_part = region.lower_part;
    blocker.type = region.type;
    const SeparationTree below(extract_part(best_.design.shape, region.upper_part)),
        above(extract_part(best_.design.shape, region.lower_part));
    SeparationOptions options;
    options.semantics = checker_.requirements().measure.semantics;
    const Stackability& measured = best_.measured;
    const Separation apart = separation(below, above, direction_, options);
    blocker.f = apart.blocked ? apart.length : measured.f_max;
    blocker.stackability = measured.value_at(blocker.f);
    if (const auto trial = trials_.tried({region}, checker_)) {
      explain(blocker, *trial);
      note(*trial);
      for (const auto& [obstacle, count] : trial->refusals) tried_refusals_[obstacle] += count;
    }
    return blocker;
  }

  /// Keeps the edit of the best trial as asked.
  void note(const EditTrial& trial) {
    if (!trial.best_edit || trial.best <= noted_) return;
    noted_ = trial.best;
    noted_edit_ = trial.best_edit;
  }

  void make_better() {
    if (!noted_edit_ || !helps(noted_)) return;
    const DeformationConstraints constraints =
        deformation_constraints(checker_.requirements(), rest_, direction_);
    DeformationResult made = checker_.space().edited(best_.design, *noted_edit_, constraints);
    if (made.refusal) return;
    Candidate candidate = best_;
    candidate.measured = checker_.check(made.design, direction_).measured;
    const double gain = best_.energy.gain + candidate.measured.value - best_.measured.value;
    candidate.energy = checker_.rest_shape().energy_meter().energy(made.design, gain);
    candidate.design = std::move(made.design);
    candidate.reasons.clear();
    diagnosis_.better = std::move(candidate);
  }

  void explain(Blocker& blocker, const EditTrial& trial) const {
    blocker.best_stackability = trial.best;
    if (trial.stopped && !helps(trial.best)) {
      blocker.edits = Blocker::Edits::unfinished;
    } else if (trial.made > 0) {
      blocker.edits = helps(trial.best) ? Blocker::Edits::helpful : Blocker::Edits::unhelpful;
    } else if (trial.refusals.empty()) {
      blocker.edits = Blocker::Edits::none;
    } else {
      std::vector<ObstacleCount> counts;
      for (const auto& [refusal, count] : trial.refusals) counts.push_back({refusal, count});
      sort_by_count(counts, rest_.structure);
      blocker.edits = Blocker::Edits::refused;
      blocker.obstacle = counts.front().obstacle;
    }
  }

  void look_elsewhere() {
    SearchOptions options;
    options.cancelled = options_.cancelled;
    options.max_directions = whole_directions(trials_.designs_left() * options_.directions_per_design);
    for (const Symmetry& symmetry : rest_.structure.symmetries) options.candidates.push_back(symmetry.axis);
    const Eigen::Vector3d direction =
        best_direction(checker_.rest_shape().solver_without_play(), options).best.direction;
    const Stackability best = checker_.rest_shape().measure(Direction(direction));
    if (!helps(best.value)) return;
    add({Remedy::Kind::other_direction, {}, {}, best.direction, best.value});
  }

  /// Adds remedies that free blocking parts, one class of symmetric parts at a time.
  void free_parts() {
    const Requirements& asked = checker_.requirements();
    for (const std::vector<int>& parts : symmetric_classes(rest_.structure)) {
      const bool blocks = std::any_of(regions_.begin(), regions_.end(), [&](const ContactRegion& region) {
        return contains(parts, region.upper_part) || contains(parts, region.lower_part);
      });
      const auto stays = [&](int part) {
        return contains(asked.kept_parts, part) ||
               (!asked.editable_parts.empty() && !contains(asked.editable_parts, part));
      };
      if (!blocks || std::none_of(parts.begin(), parts.end(), stays)) continue;
      Requirements freed = asked;
      std::erase_if(freed.kept_parts, [&](int part) { return contains(parts, part); });
      if (!freed.editable_parts.empty())
        freed.editable_parts.insert(freed.editable_parts.end(), parts.begin(), parts.end());
      offer(Remedy::Kind::free_part, freed, parts);
    }
  }

  void relax() {
    Requirements relaxed = checker_.requirements();
    if (relaxed.keep_height) {
      relaxed.keep_height = false;
      offer(Remedy::Kind::relax_height, relaxed, {});
    }
    relaxed = checker_.requirements();
    if (relaxed.box_tolerance) {
      relaxed.box_tolerance.reset();
      offer(Remedy::Kind::relax_box, relaxed, {});
    }
    if (!checker_.requirements().quality) return;
    for (std::size_t k = 0; k < quality_measure_count; ++k) {
      relaxed = checker_.requirements();
      const auto measure = static_cast<QualityMeasure>(k);
      relaxed.quality->relax(measure);
      if (*relaxed.quality != *checker_.requirements().quality && stood_in_the_way(measure))
        offer(Remedy::Kind::relax_quality, relaxed, {}, measure);
    }
  }

  /// Returns whether a design of the search had this measure of quality beyond its limit.
  bool stood_in_the_way(QualityMeasure measure) const {
    return std::any_of(refusals_.begin(), refusals_.end(), [&](const ObstacleCount& count) {
      const auto* check = std::get_if<Check>(&count.obstacle);
      return check && check->kind == CheckKind::quality && check->measure == measure;
    });
  }

  /// Adds a remedy if one edit helps under the requirements `instead` and not under those given.
  void offer(Remedy::Kind kind, const Requirements& instead, const std::vector<int>& parts,
             QualityMeasure measure = {}) {
    const std::optional<EditTrial> trial = trials_.tried(regions_, {checker_.space(), instead});
    if (!trial || !helps(trial->best)) return;
    const std::optional<double> as_asked = best_as_asked();
    if (as_asked && trial->best > *as_asked + worth_saying)
      add({kind, parts, measure, best_.direction, trial->best});
  }

  std::optional<double> best_as_asked() {
    if (!as_asked_)
      if (const auto trial = trials_.tried(regions_, checker_)) {
        as_asked_ = trial->best;
        note(*trial);
      }
    return as_asked_;
  }

  RemovalOptions along_best_direction() const {
    RemovalOptions options;
    options.measure = checker_.requirements().measure;
    options.directions = {best_.direction};
    options.cancelled = options_.cancelled;
    return options;
  }

  void remove_parts() {
    std::size_t offered = 0;
    for (const Removal& removal : removals(rest_, along_best_direction())) {
      if (offered == max_removals || !helps(removal.stackability)) break;
      if (removal.area > max_removed_area) continue;
      const bool all_may_go = std::none_of(removal.parts.begin(), removal.parts.end(), [&](int part) {
        return contains(checker_.requirements().kept_parts, part);
      });
      if (!all_may_go) continue;
      add({Remedy::Kind::remove_part, removal.parts, {}, removal.direction, removal.stackability});
      ++offered;
    }
  }

  /// Offers the partition of largest S with few pieces: all but the piece of most parts are taken off.
  void take_apart() {
    const std::vector<Partition> found = suggested_partitions(rest_, {along_best_direction(), max_pieces});
    if (found.empty() || !helps(found.front().stackability)) return;
    const std::vector<Piece>& pieces = found.front().pieces;
    const auto stays = std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
      return a.parts.size() < b.parts.size();
    });
    std::vector<int> parts;
    for (auto piece = pieces.begin(); piece != pieces.end(); ++piece)
      if (piece != stays) parts.insert(parts.end(), piece->parts.begin(), piece->parts.end());
    std::sort(parts.begin(), parts.end());
    add({Remedy::Kind::take_apart, parts, {}, best_.direction, found.front().stackability, pieces});
  }

  void add(Remedy remedy) { diagnosis_.remedies.push_back(std::move(remedy)); }

  const RequirementChecker& checker_;
  const DiagnosisOptions& options_;
  std::vector<ObstacleCount> refusals_;              ///< of the search, or of the edits that were tried here
  std::map<Obstacle, std::int64_t> tried_refusals_;  ///< of the edits that were tried here
  const Candidate& best_;
  const StructuredShape& rest_;
  Direction direction_;
  EditTrials trials_;
  StackabilitySolver solver_;
  std::vector<ContactRegion> regions_;  ///< one region per class of symmetric regions
  std::optional<double> as_asked_;      ///< largest S after one edit under the requirements given
  double noted_ = 0;                    ///< largest S of `note`
  std::optional<Edit> noted_edit_;      ///< edit that gives it
  Diagnosis diagnosis_;
};

}  // namespace

Diagnosis diagnose(const RequirementChecker& checker, const BestFirstResult& result,
                   const DiagnosisOptions& options) {
  return DiagnosisBuilder(checker, result, options).run();
}

}  // namespace stackabilization
