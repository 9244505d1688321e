#include "editing/session/handle_range.h"

#include <algorithm>
#include <utility>

#include "stackabilization/improvement/refinement.h"

namespace stackabilization::editing {

namespace {

constexpr int bisections = 6;        ///< of the part of an edit that can be made: 1/64 of what is left
constexpr int samples_per_side = 8;  ///< of a range

double stackability_of(const EditedFrom& from, const Design& design) {
  return from.workspace->checker().measure(design.shape, from.direction).value;
}

/// Samples one side of a range, from the design outwards. Returns the end of the range, and what is there.
std::pair<double, std::optional<Obstacle>> sample_side(const EditedFrom& from, HandleRange& range,
                                                       double sign, const std::function<bool()>& cancelled) {
  double reached = 0;
  for (int k = 1; k <= samples_per_side && !cancelled(); ++k) {
    const double amount = static_cast<double>(k) / samples_per_side;
    const Edit whole = with_magnitude(range.edit, sign);
    const TriedEdit tried = try_edit(from, with_magnitude(whole, amount));
    if (tried.made) {
      range.samples.push_back({sign * amount, stackability_of(from, *tried.made)});
      reached = amount;
      continue;
    }
    const LargestEdit largest = largest_part(from, with_magnitude(whole, amount), reached / amount);
    const double end = amount * largest.amount;
    if (end > reached) range.samples.push_back({sign * end, largest.made.assessment.measured.value});
    return {sign * end, largest.obstacle};
  }
  return {sign * reached, std::nullopt};
}

}  // namespace

MeasuredDesign measured(const EditedFrom& from, std::shared_ptr<const Design> design) {
  return from.workspace->measured(std::move(design), from.direction, from.at_rest, from.scope);
}

TriedEdit try_edit(const EditedFrom& from, const Edit& edit) {
  TriedEdit tried;
  DeformationResult outcome =
      from.workspace->space().edited(*from.design, edit, from.workspace->constraints(from.direction));
  if (outcome.refusal) {
    tried.obstacle = *outcome.refusal;
    return tried;
  }
  tried.obstacle = from.workspace->checker().obstacle(outcome.design, from.direction, from.scope);
  if (!tried.obstacle) tried.made = std::make_shared<const Design>(std::move(outcome.design));
  return tried;
}

LargestEdit largest_part(const EditedFrom& from, const Edit& edit, double known) {
  LargestEdit result;
  TriedEdit whole = try_edit(from, edit);
  if (whole.made) return {measured(from, std::move(whole.made)), 1, std::nullopt};
  result.obstacle = whole.obstacle;
  std::shared_ptr<const Design> made = from.design;
  double low = 0, high = 1;
  for (int k = 0; k <= bisections; ++k) {
    const double amount = k == 0 && known > 0 && known < 1 ? known : (low + high) / 2;
    TriedEdit tried = try_edit(from, with_magnitude(edit, amount));
    if (tried.made) {
      low = amount;
      made = std::move(tried.made);
    } else {
      high = amount;
      result.obstacle = tried.obstacle;
    }
  }
  result.amount = low;
  result.made = measured(from, std::move(made));
  return result;
}

HandleRange handle_range(const EditedFrom& from, const Edit& edit, const std::function<bool()>& cancelled) {
  HandleRange range;
  range.edit = edit;
  range.samples.push_back({0, stackability_of(from, *from.design)});
  std::tie(range.low, range.below) = sample_side(from, range, -1, cancelled);
  std::tie(range.high, range.above) = sample_side(from, range, 1, cancelled);
  std::sort(range.samples.begin(), range.samples.end(),
            [](const HandleRange::Sample& a, const HandleRange::Sample& b) { return a.amount < b.amount; });
  return range;
}

}  // namespace stackabilization::editing
