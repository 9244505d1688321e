#include <memory>

#include "common/provenance.h"
#include "speed/competitor.h"
#include "stackabilization/stacking/collision.h"

namespace stackabilization::experiments {

Competitor cgal_bisection(const Shape& shape) {
  Competitor result;
  result.name = "CGAL collision bisection";
  const double start = now();
  const auto tester = std::make_shared<CollisionTester>(shape, shape);
  result.build_seconds = now() - start;
  result.measure = [tester](const Direction& direction) {
    BisectionOptions options;
    options.semantics = Semantics::closed;
    options.relative_width = 1e-6;
    const auto bracket = translation_by_bisection(*tester, direction, options);
    return bracket ? bracket->free * direction.length() : 0.0;
  };
  return result;
}

}  // namespace stackabilization::experiments
