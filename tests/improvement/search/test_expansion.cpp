#include "improvement/search/expansion.h"
#include "support/catch.h"

using namespace stackabilization;
using detail::takes_back;

namespace {

const Handle handle{HandleKind::part, 2, 0};

Edit of(const Operation& operation) {
  return {handle, operation};
}

}  // namespace

TEST_CASE("a move and a leaning are taken back by those to the other side") {
  CHECK(takes_back(of(Move{{-1, 0, 0}}), of(Move{{3, 1, 0}})));
  CHECK_FALSE(takes_back(of(Move{{1, 0, 0}}), of(Move{{3, 1, 0}})));
  CHECK_FALSE(takes_back(of(Move{{0, 0, 1}}), of(Move{{3, 1, 0}})));

  const Edit leaning = of(Lean{{1, 0, 0}, {0, 0, 1}});
  CHECK(takes_back(of(Lean{{-2, 0, 0}, {0, 0, 1}}), leaning));
  CHECK_FALSE(takes_back(of(Lean{{2, 0, 0}, {0, 0, 1}}), leaning));
  CHECK_FALSE(takes_back(of(Lean{{0, 2, 0}, {0, 0, 1}}), leaning));
  // The other end to the same side takes it back, to the other side it adds.
  CHECK(takes_back(of(Lean{{2, 0, 0}, {0, 0, -1}}), leaning));
  CHECK_FALSE(takes_back(of(Lean{{-2, 0, 0}, {0, 0, -1}}), leaning));
}

TEST_CASE("a scaling and a taper are taken back by those on the other side of 1, along the same axis") {
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  CHECK(takes_back(of(Scale{0.9, {}}), of(Scale{1.2, {}})));
  CHECK_FALSE(takes_back(of(Scale{1.1, {}}), of(Scale{1.2, {}})));
  CHECK(takes_back(of(Scale{1.1, x}), of(Scale{0.9, -5 * x})));
  CHECK(takes_back(of(Scale{1.1, 5 * x}), of(Scale{0.9, x + 0.009 * y})));
  CHECK_FALSE(takes_back(of(Scale{1.1, 0.1 * x}), of(Scale{0.9, x + 0.1 * y})));
  CHECK_FALSE(takes_back(of(Scale{1.1, x}), of(Scale{0.9, y})));
  CHECK_FALSE(takes_back(of(Scale{1.1, x}), of(Scale{0.9, {}})));

  CHECK(takes_back(of(Taper{1.1, z, {}}), of(Taper{0.9, z, {}})));
  CHECK_FALSE(takes_back(of(Taper{1.1, z, {}}), of(Taper{0.9, -z, {}})));
  CHECK_FALSE(takes_back(of(Taper{1.1, z, x}), of(Taper{0.9, z, y})));
}

TEST_CASE("an edit of another handle, or another operation, takes nothing back") {
  const Edit earlier = of(Move{{1, 0, 0}});
  Edit other = of(Move{{-1, 0, 0}});
  CHECK(takes_back(other, earlier));
  other.handle.part = 1;
  CHECK_FALSE(takes_back(other, earlier));
  CHECK_FALSE(takes_back(of(Lean{{-1, 0, 0}, {0, 0, 1}}), earlier));
}
