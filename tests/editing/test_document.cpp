#include "sessions.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"
#include "support/messages.h"

using namespace stackabilization;
using namespace stackabilization::editing;

namespace {

std::string replaced(std::string text, const std::string& old, const std::string& with) {
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), with);
}

}  // namespace

TEST_CASE("a new document asks for S at rest and 0.2 more, and keeps the limits of quality") {
  const Document document = sessions::table_document();
  const double at_rest = stackability(document.project.rest.shape, {0, 0, 1}).value;
  CHECK(document.project.history.nodes.size() == 1);
  CHECK(document.project.history.nodes[0].stackability == at_rest);
  CHECK(document.requirements.target == Approx(at_rest + 0.2).margin(0.005));
  CHECK(document.requirements.quality == QualityLimits());
  CHECK(document.project.space.following == Following::smooth);
}

TEST_CASE("a document is read back as it was written") {
  Document document = sessions::table_document();
  document.requirements.target = 0.1 + 0.2;
  document.requirements.length_limit = {7, 30.1};
  document.requirements.keep_height = false;
  document.requirements.kept_parts = {structures::part_named(document.project.rest, "top")};
  document.requirements.quality->relax(QualityMeasure::bending);
  (*document.requirements.quality)[QualityMeasure::size] = 0.61;
  HistoryNode node;
  node.edits = {{{HandleKind::part, 1, 0}, Move{{0.1, 0, 0}}}};
  document.project.history = apply(document.project.history, node);
  document.visited = {0, 1, 0, 1};
  document.place = 3;
  const std::string text = document_text(document);
  const Document again = document_of_text(text, "saved");
  CHECK(document_text(again) == text);
  CHECK(again.requirements.target == document.requirements.target);
  REQUIRE(again.requirements.length_limit);
  CHECK(again.requirements.length_limit->copies == 7);
  CHECK(again.requirements.length_limit->length == 30.1);
  CHECK(again.requirements.quality == document.requirements.quality);
  CHECK(again.requirements.kept_parts == document.requirements.kept_parts);
  CHECK(again.visited == document.visited);
  CHECK(again.project.rest.shape.vertices == document.project.rest.shape.vertices);
}

TEST_CASE("a damaged document is refused with the place") {
  const std::string text = document_text(sessions::table_document());
  const auto message = [&](const std::string& old, const std::string& with) {
    return message_of<InputError>([&] { document_of_text(replaced(text, old, with), "saved"); });
  };
  CHECK(mentions(message("stackabilize session", "something else"), "/format"));
  CHECK(mentions(message("\"visited\":[0]", "\"visited\":[7]"), "/visited/0"));
  CHECK(mentions(message("\"visited\":[0]", "\"visited\":[]"), "/visited"));
  CHECK(mentions(message("\"place\":0", "\"place\":1"), "/place"));
  CHECK(mentions(message("\"limits\":{}", "\"limits\":{\"sise\":1}"), "did you mean 'size'"));
  CHECK(mentions(message("\"limits\":{}", "\"limits\":{\"size\":-1}"), "/limits"));
  CHECK(mentions(message("\"kept_parts\":[]", "\"kept_parts\":[\"wheel\"]"), "/kept_parts"));
  CHECK(mentions(message("\"target\":", "\"aim\":"), "aim"));
  const auto within = [&](const std::string& value) {
    return message("\"within\":null", "\"within\":" + value);
  };
  CHECK(mentions(within("7"), "/within"));
  CHECK(mentions(within("{\"copies\":1,\"length\":3}"), "/within/copies"));
  CHECK(mentions(within("{\"copies\":2,\"length\":0}"), "/within/length"));
  CHECK(mentions(within("{\"copies\":2}"), "length"));
  // Sessions that were saved before there were lengths have none.
  CHECK(!document_of_text(replaced(text, ",\"within\":null", ""), "saved").requirements.length_limit);
  CHECK(!message_of<InputError>([&] { document_of_text(text.substr(0, text.size() / 2), "saved"); }).empty());
}
