#include <memory>

#include "common/clock.h"
#include "speed/competitor.h"
#include "stackabilization/stacking/collision.h"

namespace stackabilization::experiments {

std::vector<Competitor> cgal_bisections(const Shape& shape) {
  const Stopwatch watch;
  const auto tester = std::make_shared<CollisionTester>(shape, shape);
  const double build_seconds = watch.processor_seconds();
  const auto bisection = [&](const std::string& name, ContactSemantics semantics) {
    return Competitor{name, semantics, build_seconds, [tester, semantics](const Direction& direction) {
                        BisectionOptions options;
                        options.semantics = semantics;
                        options.relative_width = 1e-6;
                        const auto bracket = translation_by_bisection(*tester, direction, options);
                        return bracket ? bracket->free * direction.length() : 0.0;
                      }};
  };
  std::vector<Competitor> list{bisection("CGAL contact bisection", ContactSemantics::closed)};
  if (tester->solids()) list.push_back(bisection("CGAL interior bisection", ContactSemantics::solid));
  return list;
}

}  // namespace stackabilization::experiments
