#include "stackabilization/structure/relation_graph.h"
#include "support/catch.h"

using namespace stackabilization;

namespace {

Relation relation(RelationType type, std::vector<int> parts) {
  return {.type = type, .parts = std::move(parts), .symmetry = {}, .points = {}};
}

/// Top with two legs, a bar between the legs, and a ball that nothing holds.
Structure trestle() {
  Structure structure;
  for (const char* name : {"top", "leg \"a\"", "leg b", "ball", "bar"})
    structure.parts.push_back({name, cuboid_of({}), {}});
  structure.parts[3].primitive = GeneralizedCylinder{};
  structure.relations = {
      relation(RelationType::point_joint, {0, 1}), relation(RelationType::point_joint, {2, 0}),
      relation(RelationType::self_symmetry, {0}),  relation(RelationType::symmetry, {1, 2}),
      relation(RelationType::line_joint, {1, 4}),  relation(RelationType::point_joint, {4, 2}),
      relation(RelationType::point_joint, {0, 1})};
  return structure;
}

}  // namespace

TEST_CASE("incident relations come symmetry first, each once, then by row") {
  const RelationGraph graph(trestle());
  CHECK(graph.incident(0) == std::vector<int>{2, 0, 1, 6});
  CHECK(graph.incident(1) == std::vector<int>{3, 0, 6, 4});
  CHECK(graph.incident(2) == std::vector<int>{3, 1, 5});
  CHECK(graph.incident(3).empty());
  CHECK(graph.opposite(3, 1) == 2);
  CHECK(graph.opposite(3, 2) == 1);
  CHECK(graph.opposite(2, 0) == 0);
  CHECK(graph.neighbours(0) == std::vector<int>{1, 2});
  CHECK(graph.neighbours(1) == std::vector<int>{0, 2, 4});
}

TEST_CASE("components are numbered in the order of the parts") {
  CHECK(RelationGraph(trestle()).components() == std::vector<int>{0, 0, 0, 1, 0});
  CHECK(RelationGraph({}).components().empty());
}

TEST_CASE("the picture names every part and relation, quotes escaped") {
  const std::string text = graphviz(trestle());
  CHECK(text.find("graph G {") == 0);
  CHECK(text.find(R"(0[label=top shape=box];)") != std::string::npos);
  CHECK(text.find(R"(1[label="leg \"a\"" shape=box];)") != std::string::npos);
  CHECK(text.find(R"(3[label=ball shape=ellipse];)") != std::string::npos);
  CHECK(text.find("0--0 [style=dotted];") != std::string::npos);
  CHECK(text.find("1--4 [color=red];") != std::string::npos);
  CHECK(text.find("4--2 [color=green];") != std::string::npos);
  CHECK(text.find("1--2 [color=\"black:invis:black\"];") != std::string::npos);
}
