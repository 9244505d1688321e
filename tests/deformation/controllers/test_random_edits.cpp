#include <thread>

#include "support/catch.h"
#include "support/random_edits.h"
#include "support/structures.h"

using namespace stackabilization;
using namespace stackabilization::random_edits;

TEST_CASE("a thousand random edits leave no broken relation, and most of them are made") {
  const std::map<std::string, StructuredShape> rests = {
      {"table", structures::table(1)},
      {"table with line joints", structures::table_with_line_joints()},
      {"mug", structures::mug(12)},
      {"post with ring", structures::post_with_ring()}};
  for (const auto& [name, rest] : rests) {
    const ControllerModel model(rest);
    const std::map<std::string, Tally> tallies = run(model, 1000, 42);
    report(name, tallies);
    INFO(name);
    CHECK(acceptance(tallies) > 0.8);
  }
}

TEST_CASE("edits give the same bytes from any number of threads") {
  const ControllerModel model(structures::table_with_line_joints());
  const Edit edit{{HandleKind::face, 1, 4}, Move{{-0.3, -0.2, 0.1}}};
  const Points alone = model.deformed({edit}).design.shape.vertices;
  std::vector<Points> together(4);
  std::vector<std::thread> threads;
  for (Points& vertices : together)
    threads.emplace_back([&] { vertices = model.deformed({edit}).design.shape.vertices; });
  for (std::thread& thread : threads) thread.join();
  for (const Points& vertices : together) CHECK(vertices == alone);
}
