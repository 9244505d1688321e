#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/partition.h"
#include "support/catch.h"
#include "support/structures.h"

namespace stackabilization {
namespace {

std::vector<std::vector<int>> groups_of(const Partition& partition) {
  std::vector<std::vector<int>> groups;
  for (const Piece& piece : partition.pieces) groups.push_back(piece.parts);
  return groups;
}

TEST_CASE("a table is cut between its classes of parts, and the saving is that of Eq. 3") {
  const StructuredShape table = structures::table();
  const std::vector<Partition> found = suggested_partitions(table);
  REQUIRE(found.size() == 4);
  const double whole = 8 * 8 * 6, top = 8 * 8 * 0.5, leg = 0.8 * 0.8 * 5.5, bar = 6.2 * 0.4 * 0.4;
  // Legs apart from everything: boxes, which save nothing but the room between them.
  CHECK(groups_of(found[0]) == std::vector<std::vector<int>>{{0}, {1}, {2}, {3}, {4}, {5}, {6}, {7}, {8}});
  CHECK(found[0].stackability == Approx(1 - (top + 4 * leg + 4 * bar) / whole));
  // The top off: the frame of legs and bars.
  CHECK(groups_of(found[1]) == std::vector<std::vector<int>>{{0}, {1, 2, 3, 4, 5, 6, 7, 8}});
  CHECK(found[1].stackability == Approx(1 - (top + 7.8 * 7.8 * 5.5) / whole));
  // Two bars out: as much left twice, and no part is lost.
  CHECK(groups_of(found[2]) == std::vector<std::vector<int>>{{0, 1, 2, 3, 4, 6, 8}, {5}, {7}});
  CHECK(found[2].stackability == Approx(found[3].stackability));
  PartitionOptions few;
  few.max_pieces = 2;
  REQUIRE(suggested_partitions(table, few).size() == 1);
  CHECK(groups_of(suggested_partitions(table, few)[0]) == groups_of(found[1]));
  for (const Partition& partition : found)
    for (const Piece& piece : partition.pieces) CHECK(piece.stackability <= 1);
}

TEST_CASE("equal cuts are suggested once, and none where there is no joint") {
  const StructuredShape mug = structures::mug();
  const std::vector<Partition> found = suggested_partitions(mug);  // body from handle, handle from body
  REQUIRE(found.size() == 1);
  CHECK(groups_of(found[0]) == std::vector<std::vector<int>>{{0}, {1}});
  CHECK(suggested_partitions(structures::box_alone({1, 2, 3})).empty());
}

TEST_CASE("suggestions refuse a whole without volume and no direction") {
  PartitionOptions nowhere;
  nowhere.directions.clear();
  CHECK_THROWS_AS(suggested_partitions(structures::table(), nowhere), UsageError);
  StructuredShape flat = structures::box_alone({1, 2, 3});
  flat.shape.vertices.col(2).setZero();
  CHECK_THROWS_AS(suggested_partitions(flat), InputError);
}

}  // namespace
}  // namespace stackabilization
