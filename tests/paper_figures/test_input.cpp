#include <functional>

#include "paper_figures/figure.h"
#include "paper_figures/folder.h"
#include "paper_figures/run.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"
#include "support/messages.h"

using namespace stackabilization;
using namespace stackabilization::figures;

namespace {

/// What reading `text` and then `body` complains about.
std::string complaint_about_fields(const std::string& text, const std::function<void(const Fields&)>& body) {
  const Folder folder;
  const std::filesystem::path path = folder.file("figure_01.json", text);
  const std::string message = message_of<InputError>([&] { body(Fields::of_file(path)); });
  const std::string name = path.string();
  return message.starts_with(name) ? message.substr(name.size()) : message;
}

}  // namespace

TEST_CASE("entries are read as what they are") {
  const Folder folder;
  const Fields fields = Fields::of_file(folder.file(
      "a.json", R"({"t": "words", "n": -2.5, "w": 7, "v": [1, 0.1, 3], "o": {"k": 1}, "l": [{"k": 2}],
                    "s": ["a", "b"]})"));
  CHECK(fields.text("t") == "words");
  CHECK(fields.number("n") == -2.5);
  CHECK(fields.whole("w", 1, 7) == 7);
  CHECK(fields.vector("v") == Eigen::Vector3d(1, 0.1, 3));
  CHECK(fields.object("o").number("k") == 1);
  CHECK(fields.objects("l").front().number("k") == 2);
  CHECK(fields.texts("s") == std::vector<std::string>{"a", "b"});
  CHECK(!fields.has("x"));
  fields.refuse_unread();
}

TEST_CASE("what an input should not have is refused with file and place") {
  const auto nothing = [](const Fields&) {};
  CHECK(complaint_about_fields("{", nothing) == ", byte 2: expected a JSON text");
  CHECK(complaint_about_fields("[1]", nothing) == ": expected an object");
  CHECK(complaint_about_fields(R"({"a": 1, "a": 2})", nothing) ==
        ": the entry 'a' stands twice in one object");
  CHECK(complaint_about_fields(R"({"a": {"b": 1, "c": {"b": 2}}})", nothing) ==
        "accepted");  // different objects
  CHECK(complaint_about_fields("{}", [](const Fields& f) { f.number("a"); }) ==
        ": /a: expected such an entry, found none");
  CHECK(complaint_about_fields(R"({"a": "1"})", [](const Fields& f) { f.number("a"); }) ==
        ": /a: expected a finite number");
  CHECK(complaint_about_fields(R"({"a": 1e999})", nothing) ==
        ": expected numbers that fit into double precision");
  CHECK(complaint_about_fields(R"({"a": ""})", [](const Fields& f) { f.text("a"); }) ==
        ": /a: expected a text");
  CHECK(complaint_about_fields(R"({"a": 8})", [](const Fields& f) { f.whole("a", 1, 7); }) ==
        ": /a: expected a whole number from 1 to 7");
  CHECK(complaint_about_fields(R"({"a": 2.5})", [](const Fields& f) { f.whole("a", 1, 7); }) ==
        ": /a: expected a whole number from 1 to 7");
  CHECK(complaint_about_fields(R"({"a": [1, 2]})", [](const Fields& f) { f.vector("a"); }) ==
        ": /a: expected three numbers");
  CHECK(complaint_about_fields(R"({"a": []})", [](const Fields& f) { f.objects("a"); }) ==
        ": /a: expected a list of one or more objects");
  CHECK(complaint_about_fields(R"({"a": [{}, 3]})", [](const Fields& f) { f.objects("a"); }) ==
        ": /a/1: expected an object");
  CHECK(complaint_about_fields(R"({"o": {"k": "x"}})", [](const Fields& f) { f.object("o").number("k"); }) ==
        ": /o/k: expected a finite number");
}

TEST_CASE("an entry that nobody reads is refused, however deep it is") {
  const auto reader = [](const Fields& fields) {
    for (const Fields& one : fields.objects("l")) one.number("k");
    fields.refuse_unread();
  };
  CHECK(complaint_about_fields(R"({"l": [{"k": 1}, {"k": 2}]})", reader) == "accepted");
  CHECK(complaint_about_fields(R"({"l": [{"k": 1}, {"k": 2, "z": 0}]})", reader) ==
        ": /l/1/z: this entry is not known");
  CHECK(complaint_about_fields(R"({"l": [{"k": 1}], "kk": 1})", reader) == ": /kk: this entry is not known");
}

TEST_CASE("a model has a file, and units and axes that exist") {
  const auto read = [](const Fields& fields) { read_model_source(fields.object("model")); };
  CHECK(complaint_about_fields(R"({"model": {"file": "a.obj", "unit": "m", "up": "y"}})", read) ==
        "accepted");
  CHECK(complaint_about_fields(R"({"model": {"file": "a.obj", "unit": "yd"}})", read) ==
        ": /model/unit: expected mm, cm or m");
  CHECK(complaint_about_fields(R"({"model": {"file": "a.obj", "up": "w"}})", read) ==
        ": /model/up: expected x, y or z");
  CHECK(complaint_about_fields(R"({"model": {}})", read) ==
        ": /model/file: expected such an entry, found none");
}

TEST_CASE("every figure of the catalogue has an input that it understands") {
  const std::filesystem::path inputs = std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "paper_figures";
  int last = 0;
  for (const Figure& figure : all_figures()) {
    CHECK(figure.number > last);
    last = figure.number;
    const Fields fields = Fields::of_file(inputs / (stem_of(figure.number) + ".json"));
    CHECK(fields.whole("figure", 1, 15) == figure.number);
    CHECK(fields.text("paper").ends_with('.'));
    CHECK(fields.text("difference").ends_with('.'));
    figure.prepare(fields.object("own"));
    if (fields.has("authors")) {
      figure.prepare(fields.object("authors"));
      const std::string difference = fields.object("authors").text("difference");
      CHECK(difference.ends_with('.'));
      CHECK(difference.find("this project's model") == std::string::npos);
    }
    fields.refuse_unread();
  }
}
