#include "stackabilization/improvement/explanation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/index.h"
#include "improvement/design/members.h"
#include "improvement/explanation/part_changes.h"
#include "improvement/explanation/part_nouns.h"
#include "improvement/explanation/part_phrases.h"
#include "improvement/quality/surface_marks.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/improvement/tolerances.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization {

namespace {

using namespace detail;
using Kind = FormChangeKind;
namespace limit = tolerance::explanation;

bool is_size(Kind kind) {
  return kind != Kind::lean && kind != Kind::tilt && kind != Kind::turn && kind != Kind::rise &&
         kind != Kind::shift;
}

bool is_place(Kind kind) {
  return kind == Kind::rise || kind == Kind::shift;
}

/// Returns the change of a kind whose amount is nearest: a part may get wider one way and narrower the other
/// way. One by 0 without any.
SeenChange found(const PartChanges& changes, const FormChange& like) {
  SeenChange nearest{{like.kind, 0, like.heading}, 0};
  double distance = std::numeric_limits<double>::infinity();
  for (const SeenChange& one : changes.changes) {
    const double apart = std::abs(one.change.amount - like.amount);
    if (one.change.kind != like.kind || one.change.heading != like.heading || apart >= distance) continue;
    nearest = one;
    distance = apart;
  }
  return nearest;
}

/// Returns whether a person would describe two changes by the same words.
bool are_alike(const PartChanges& a, const PartChanges& b) {
  const auto covers = [](const PartChanges& one, const PartChanges& other) {
    return std::all_of(one.changes.begin(), one.changes.end(), [&](const SeenChange& seen) {
      const double x = seen.change.amount, y = found(other, seen.change).change.amount;
      const double allowed = std::max(limit::alike * std::max(std::abs(x), std::abs(y)), seen.least);
      return std::abs(x - y) <= allowed;
    });
  };
  return covers(a, b) && covers(b, a);
}

/// Describes the change of one object.
class ChangeDescription {
 public:
  ChangeDescription(const StructuredShape& rest, const Shape& now, const ExplanationOptions& options)
      : rest_(rest), now_(now), options_(options) {
    require_match();
    const std::vector<std::vector<std::int32_t>> triangles = triangles_of_parts(rest.shape);
    for (std::size_t part = 0; part < triangles.size(); ++part)
      parts_.push_back(part_at_rest(rest, part, triangles[part]));
    find_frame();
    phrases_.emplace(rest.shape.part_names, part_nouns(rest, parts_, frame_));
  }

  Explanation run() {
    result_.diagonal = frame_.diagonal;
    result_.height = frame_.height;
    result_.unit = rest_.shape.unit;
    if (!(frame_.diagonal > 0)) return std::move(result_);
    if (parts_.size() > 1 && changed_as_a_whole()) return std::move(result_);
    for (const PartAtRest& part : parts_)
      changes_.push_back(part.form.fit ? part_changes(part, rest_.shape, now_, frame_) : PartChanges{});
    leave_out_minor(changes_);
    find_classes();
    leave_out_barely_seen();
    find_groups();
    fold_followers();
    for (std::size_t k = 0; k < groups_.size(); ++k)
      if (!folded_[k]) result_.groups.push_back(described(groups_[k]));
    std::stable_sort(result_.groups.begin(), result_.groups.end(), [](const auto& a, const auto& b) {
      return std::pair(-a.displacement, !a.edited) < std::pair(-b.displacement, !b.edited);
    });
    return std::move(result_);
  }

 private:
  struct Group {
    std::vector<int> parts, followers;
    bool edited = false;
    double area = 0;
  };

  void require_match() const {
    validate(rest_);
    if (now_.vertex_count() != rest_.shape.vertex_count() || now_.triangles != rest_.shape.triangles ||
        now_.triangle_part != rest_.shape.triangle_part)
      throw UsageError("the description of a change needs the triangles and parts of the object at rest");
  }

  void find_frame() {
    frame_.up = Direction(options_.up).unit();
    const Range range = range_along(rest_.shape, frame_.up);
    frame_.ground = range.low;
    frame_.diagonal = rest_.structure.diagonal;
    frame_.height = range.length() > 0 ? range.length() : frame_.diagonal;
    frame_.centre = HullSupport(rest_.shape).box_along(Direction(frame_.up)).centre;
    frame_.shift = level_shift() + (range_along(now_, frame_.up).low - range.low) * frame_.up;
  }

  /// Returns the level displacement of the part to which the others move least.
  Eigen::Vector3d level_shift() const {
    std::vector<std::pair<Eigen::Vector3d, double>> moves;
    for (const PartAtRest& part : parts_)
      if (part.form.fit) {
        const AffineMap map = part.form.fit->map(part.form.marks.on(now_));
        moves.emplace_back(frame_.level(map.to - map.from), part.area);
      }
    Eigen::Vector3d best = Eigen::Vector3d::Zero();
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [move, own_area] : moves) {
      double sum = 0;
      for (const auto& [other, area] : moves) sum += area * (other - move).norm();
      if (sum < least) std::tie(best, least) = std::pair(move, sum);
    }
    return best;
  }

  /// Describes the whole if one affine map other than a displacement changed it.
  bool changed_as_a_whole() {
    std::vector<std::int32_t> all(static_cast<std::size_t>(rest_.shape.triangle_count()));
    std::iota(all.begin(), all.end(), 0);
    PartAtRest whole;
    whole.form.marks = marks_on(rest_.shape, all, marks_of_object);
    if (whole.form.marks.size() == 0) return false;
    whole.form.fit.emplace(whole.form.marks.on(rest_.shape));
    whole.low.setZero();
    whole.high.setZero();
    whole.triangles = std::move(all);
    std::vector<PartChanges> measured = {part_changes(whole, rest_.shape, now_, frame_)};
    leave_out_minor(measured);
    const PartChanges& changes = measured.front();
    if (changes.displacement < frame_.visible()) return true;
    for (const std::int32_t t : whole.triangles)
      for (int k = 0; k < 3; ++k)
        if ((changes.map(rest_.shape.corner(t, k)) + frame_.shift - now_.corner(t, k)).norm() >
            frame_.visible())
          return false;
    GroupChange group;
    group.parts.resize(parts_.size());
    std::iota(group.parts.begin(), group.parts.end(), 0);
    group.name = "whole object";
    group.displacement = changes.displacement / frame_.diagonal;
    for (const SeenChange& one : changes.changes)
      if (!is_place(one.change.kind)) group.changes.push_back(one.change);
    result_.groups.push_back(std::move(group));
    return true;
  }

  void find_classes() {
    classes_ = symmetric_classes(rest_.structure);
    class_of_.resize(parts_.size());
    for (std::size_t k = 0; k < classes_.size(); ++k)
      for (const int part : classes_[k]) class_of_[at(part)] = k;
    edited_.assign(classes_.size(), false);
    for (const Edit& edit : options_.edits)
      if (const std::optional<int> part = edited_part(edit)) edited_[class_of_[at(*part)]] = true;
  }

  /// Of symmetric parts that move as far, tells of none where one is not seen to change: rounding must not
  /// part them.
  void leave_out_barely_seen() {
    for (const std::vector<int>& parts : classes_)
      for (const int unseen : parts) {
        if (!changes_[at(unseen)].changes.empty()) continue;
        for (const int part : parts)
          if (changes_[at(part)].displacement * (1 - limit::alike) <= changes_[at(unseen)].displacement)
            changes_[at(part)].changes.clear();
      }
  }

  std::optional<int> edited_part(const Edit& edit) const {
    const HandleKind kind = edit.handle.kind;
    if (kind == HandleKind::point || kind == HandleKind::wire || kind == HandleKind::shape)
      return std::nullopt;
    return edit.handle.part;
  }

  void find_groups() {
    for (int part = 0; part < static_cast<int>(parts_.size()); ++part) {
      const PartChanges& own = changes_[at(part)];
      if (own.changes.empty()) continue;
      const auto fits = [&](const Group& group) {
        const int first = group.parts.front();
        const bool related =
            class_of_[at(first)] == class_of_[at(part)] || phrases_->noun(first) == phrases_->noun(part);
        return related && are_alike(changes_[at(first)], own);
      };
      auto group = std::find_if(groups_.begin(), groups_.end(), fits);
      if (group == groups_.end()) group = groups_.insert(group, Group{});
      group->parts.push_back(part);
      group->edited = group->edited || edited_[class_of_[at(part)]];
      group->area += parts_[at(part)].area;
    }
    folded_.assign(groups_.size(), false);
  }

  bool has_size(const Group& group) const {
    const std::vector<SeenChange>& changes = changes_[at(group.parts.front())].changes;
    return std::any_of(changes.begin(), changes.end(), [](const auto& c) { return is_size(c.change.kind); });
  }
  bool only_moves(const Group& group) const {
    const std::vector<SeenChange>& changes = changes_[at(group.parts.front())].changes;
    return std::all_of(changes.begin(), changes.end(), [](const auto& c) { return is_place(c.change.kind); });
  }

  /// Returns whether a part moves as the surface of a joined part does: at the joint, and if it turns, in its
  /// whole box.
  bool moves_along(int follower, int carrier, const Relation& joint) const {
    const PartChanges &own = changes_[at(follower)], &other = changes_[at(carrier)];
    std::vector<Eigen::Vector3d> places;
    for (Eigen::Index k = 0; k < joint.points.rows(); ++k) places.push_back(joint.points.row(k).transpose());
    if (!only_moves({{follower}, {}}))
      for (int corner = 0; corner < 8; ++corner) {
        const PartAtRest& part = parts_[at(follower)];
        Eigen::Vector3d p;
        for (int k = 0; k < 3; ++k) p(k) = (corner >> k & 1) != 0 ? part.high(k) : part.low(k);
        places.push_back(part.form.fit->centre() + part.form.fit->axes() * p);
      }
    return std::all_of(places.begin(), places.end(), [&](const Eigen::Vector3d& p) {
      return (own.map(p) - other.map(p)).norm() <= 2 * frame_.visible();
    });
  }

  /// Returns whether each part of a group moves along with some part of the other group.
  bool follows(const Group& group, const Group& carrier) const {
    return std::all_of(group.parts.begin(), group.parts.end(), [&](int part) {
      return std::any_of(
          rest_.structure.relations.begin(), rest_.structure.relations.end(), [&](const Relation& relation) {
            if (!relation.is_joint()) return false;
            const int other = relation.parts[0] == part ? relation.parts[1] : relation.parts[0];
            if (relation.parts[0] != part && relation.parts[1] != part) return false;
            const bool carries =
                std::find(carrier.parts.begin(), carrier.parts.end(), other) != carrier.parts.end() ||
                std::find(carrier.followers.begin(), carrier.followers.end(), other) !=
                    carrier.followers.end();
            return carries && moves_along(part, other, relation);
          });
    });
  }

  /// Adds rigid groups that no edit names to the groups that carry them. What is edited or deformed carries;
  /// of the others the larger ones.
  void fold_followers() {
    std::vector<std::size_t> carriers, open;
    for (std::size_t k = 0; k < groups_.size(); ++k)
      (groups_[k].edited || has_size(groups_[k]) ? carriers : open).push_back(k);
    std::stable_sort(open.begin(), open.end(),
                     [&](std::size_t a, std::size_t b) { return groups_[a].area > groups_[b].area; });
    while (!open.empty()) {
      bool any = false;
      for (const std::size_t k : std::vector<std::size_t>(open)) {
        const auto carrier = std::find_if(carriers.begin(), carriers.end(),
                                          [&](std::size_t c) { return follows(groups_[k], groups_[c]); });
        if (carrier == carriers.end()) continue;
        std::vector<int>& followers = groups_[*carrier].followers;
        followers.insert(followers.end(), groups_[k].parts.begin(), groups_[k].parts.end());
        std::sort(followers.begin(), followers.end());
        folded_[k] = true;
        std::erase(open, k);
        any = true;
      }
      if (any) continue;
      carriers.push_back(open.front());
      open.erase(open.begin());
    }
  }

  GroupChange described(const Group& group) const {
    GroupChange result;
    const PartPhrase phrase = phrases_->phrase(group.parts);
    result.parts = group.parts;
    result.name = phrase.words;
    result.plural = phrase.plural;
    for (const SeenChange& one : changes_[at(group.parts.front())].changes)
      result.changes.push_back(one.change);
    for (const int part : group.parts)
      result.displacement = std::max(result.displacement, changes_[at(part)].displacement / frame_.diagonal);
    result.edited = group.edited;
    result.cleared = cleared_by(group);
    result.followers = group.followers;
    if (!group.followers.empty()) result.followers_name = phrases_->phrase(group.followers).words;
    return result;
  }

  /// Returns what the edits of a group avoid, without repetition.
  std::vector<std::string> cleared_by(const Group& group) const {
    const std::string any_part = "the next copy";
    std::vector<std::string> result;
    if (options_.reasons.size() != options_.edits.size()) return result;
    std::set<std::size_t> own;
    for (const int part : group.parts) own.insert(class_of_[at(part)]);
    for (std::size_t k = 0; k < options_.edits.size(); ++k) {
      const std::optional<int> part = edited_part(options_.edits[k]);
      const EditReason& reason = options_.reasons[k];
      if (reason.effect == EditEffect::compensation) continue;
      // An edit of the whole shape has its reason for all parts but the one that is avoided.
      const bool whole = options_.edits[k].handle.kind == HandleKind::shape &&
                         !(reason.away_from >= 0 && own.contains(class_of_[at(reason.away_from)]));
      if (!whole && (!part || !own.contains(class_of_[at(*part)]))) continue;
      const std::string name =
          reason.away_from < 0 ? any_part
                               : "the " + phrases_->phrase(classes_[class_of_[at(reason.away_from)]]).words +
                                     " of the next copy";
      if (std::find(result.begin(), result.end(), name) == result.end()) result.push_back(name);
    }
    if (result.size() > 1) std::erase(result, any_part);  // it says less than a name
    return result;
  }

  static constexpr int marks_of_object = 600;

  const StructuredShape& rest_;
  const Shape& now_;
  const ExplanationOptions& options_;
  ObjectFrame frame_;
  std::vector<PartAtRest> parts_;
  std::optional<PartPhrases> phrases_;
  std::vector<PartChanges> changes_;  ///< per part
  std::vector<std::vector<int>> classes_;
  std::vector<std::size_t> class_of_;  ///< per part
  std::vector<bool> edited_;           ///< per class
  std::vector<Group> groups_;
  std::vector<bool> folded_;  ///< per group
  Explanation result_;
};

}  // namespace

Explanation explain(const StructuredShape& rest, const Shape& now, const ExplanationOptions& options) {
  return ChangeDescription(rest, now, options).run();
}

}  // namespace stackabilization
