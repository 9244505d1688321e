#include <tbb/global_control.h>

#include "envelope/separation/separation_tree.h"
#include "stackabilization/envelope/separation.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

template <class Task>
auto with_threads(int count, const Task& task) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, count);
  return task();
}

/// Large enough for several tasks in the tree, 20480 triangles, and without symmetry.
Shape large_shape() {
  return transformed(solids::sphere(1, 5), solids::random_rotation(3), Eigen::Vector3d(0.1, 0.2, 0.3));
}

bool same_node(const TreeNode& a, const TreeNode& b) {
  return a.low == b.low && a.high == b.high && a.normal == b.normal && a.slab_low == b.slab_low &&
         a.slab_high == b.slab_high && a.first == b.first && a.count == b.count;
}

}  // namespace

TEST_CASE("one and two threads build the same tree of a large shape") {
  const Shape shape = large_shape();
  const auto build = [&] { return SeparationTree(shape); };
  const SeparationTree one = with_threads(1, build), two = with_threads(2, build);
  REQUIRE(one.data().nodes.size() == two.data().nodes.size());
  REQUIRE(one.data().triangles.size() == two.data().triangles.size());
  REQUIRE(one.data().triangles.size() >= 20480);
  std::size_t different = 0;
  for (std::size_t n = 0; n < one.data().nodes.size(); ++n)
    different += !same_node(one.data().nodes[n], two.data().nodes[n]);
  for (std::size_t t = 0; t < one.data().triangles.size(); ++t)
    different += one.data().triangles[t].index != two.data().triangles[t].index;
  CHECK(different == 0);
}

TEST_CASE("one and two threads measure a large shape alike, to the bit") {
  const Shape shape = large_shape();
  for (const Direction& r : {Direction(0, 0, 1), Direction(0.3, -0.2, 1)}) {
    const auto exact = [&] { return minimal_stacking_translation(shape, r); };
    const Separation one = with_threads(1, exact), two = with_threads(2, exact);
    CHECK(one.value == two.value);
    CHECK(one.witness.upper_triangle == two.witness.upper_triangle);
    CHECK(one.witness.lower_triangle == two.witness.lower_triangle);
    CHECK(one.witness.upper_point == two.witness.upper_point);
    const auto enclosure = [&] {
      const SeparationTree tree(shape);
      return separation_enclosure(tree, tree, r);
    };
    const Enclosure a = with_threads(1, enclosure), b = with_threads(2, enclosure);
    CHECK(a.lower == b.lower);
    CHECK(a.upper == b.upper);
  }
}
