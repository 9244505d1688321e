#include "stackabilization/deformation/refusal.h"

#include <cmath>
#include <string_view>

#include "core/index.h"
#include "stackabilization/core/number_text.h"

namespace stackabilization {

namespace {

/// One sentence per cause, in the order of RefusalCause. "%p": the part; "%r": the relation; "%i", "%o" and
/// "%s": index, other and symmetry; "%x": the index as the name of an axis; "%a": the axis; "%3" and "%4":
/// the amount to that many digits. What stands in brackets is left out where the amount is not told.
constexpr std::array<std::string_view, static_cast<std::size_t>(RefusalCause::uneven_row) + 1> sentences = {
    "'%p' is fixed, or symmetric to a part that is",
    "%r does not let the shape go where the edit takes it[: it would be off by %3 of the diagonal]",
    "%r does not let '%p' go where the edit takes it[: it would miss by %3 of the diagonal]",
    "%r does not let '%p' go where the edit takes it[: it would miss by %3 radians]",
    "%r would be off[ by %3 of the diagonal]",
    "'%p' would leave the range of numbers",
    "'%p' is turned inside out at corner %i",
    "'%p' collapses at corner %i",
    "'%p' loses the radius of cross-section %i",
    "'%p' collapses after cross-section %i",
    "'%p' folds after cross-section %i",
    "a fixed point would move[ by %3 of the diagonal]",
    "the extent along %a would begin or end elsewhere[, off by %3 of the diagonal]",
    "the extent along %a would be too long[ by %3 of the diagonal]",
    "the extent along %a would be too short[ by %3 of the diagonal]",
    "the edit takes vertex %i out of the range of numbers",
    "the edit would move what is to stay fixed (vertex %i)[ by %4 of the diagonal]",
    "the edit would flatten the shape along the direction whose extent is kept[ by %4 of the diagonal]",
    "what is fixed leaves the lower end of the extent no room to be kept[: it changes by %4 of the diagonal]",
    "what is fixed leaves the upper end of the extent no room to be kept[: it changes by %4 of the diagonal]",
    "the edit would change the side of the box along %x[ by %4 of the diagonal]",
    "wire %i would come apart from wire %o[, by %3 of the diagonal]",
    "wire %i would leave the plane of wire %o[, by %3 of the diagonal]",
    "wire %i would no longer be the image of wire %o under a symmetry[, by %3 of the diagonal]",
    "wire %i would leave a point that is to stay[, by %3 of the diagonal]",
    "wire %i would change the extent that is to be kept[, by %3 of the diagonal]",
    "wire %i would shrink to nothing or turn inside out[, by %3 of the diagonal]",
    "symmetry %s would no longer be one[, by %3 of any length]",
    "wire %i would no longer be the image of wire %o under symmetry %s[, by %3 of the diagonal]",
    "'%p' would lose its proportions",
    "nothing would change",
    "stackability or distortion would be undefined",
    "triangle %i loses a side",
    "the row around '%p' would no longer be even[, off by %3 of the diagonal]",
};
static_assert(!sentences.back().empty(), "every cause needs its sentence");

std::string number(double value, int digits) {
  return value == Refusal::untold ? "..." : significant_text(value, digits);
}

std::string name_of(int relation, const Structure& structure) {
  if (relation < 0) return "rounding";
  return "the " + describe(structure.relations.at(detail::at(relation)), structure);
}

/// Returns the text of one placeholder of a sentence.
std::string filled(char placeholder, const Refusal& refusal, const Structure& structure) {
  switch (placeholder) {
    case 'p':
      return structure.parts.at(detail::at(refusal.part)).name;
    case 'r':
      return name_of(refusal.relation, structure);
    case 'i':
      return std::to_string(refusal.index);
    case 'o':
      return std::to_string(refusal.other);
    case 's':
      return std::to_string(refusal.symmetry);
    case 'x':
      return {std::string_view("xyz").at(detail::at(refusal.index))};
    case 'a': {
      std::string text = "(";
      for (const double component : refusal.axis) {
        if (text.size() > 1) text += ", ";
        text += number(component, 3);
      }
      return text += ")";
    }
    default:
      return number(refusal.amount, placeholder - '0');
  }
}

}  // namespace

Refusal without_amounts(Refusal refusal) {
  constexpr double one = 0.9995;  // reads 1 to three digits
  refusal.amount = Refusal::untold;
  for (double& component : refusal.axis)
    component = component == 0 || std::abs(component) >= one ? std::round(component) + 0.0 : Refusal::untold;
  return refusal;
}

std::string describe(const Refusal& refusal, const Structure& structure) {
  const std::string_view sentence = sentences.at(static_cast<std::size_t>(refusal.cause));
  std::string text;
  for (std::size_t k = 0; k < sentence.size(); ++k)
    if (sentence[k] == '[' && refusal.amount == Refusal::untold)
      k = sentence.find(']', k);
    else if (sentence[k] == '%')
      text += filled(sentence[++k], refusal, structure);
    else if (sentence[k] != '[' && sentence[k] != ']')
      text += sentence[k];
  return text;
}

}  // namespace stackabilization
