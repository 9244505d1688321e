// The editor behind its page: what it makes of commands, of failures, and of files that it cannot have.
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <new>
#include <optional>
#include <stdexcept>
#include <thread>

#include "apps/common/page_files.h"
#include "apps/editor/page_command.h"
#include "apps/editor/room.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/read_file.h"
#include "support/catch.h"
#include "support/meshes.h"
#include "support/messages.h"
#include "support/structures.h"

using namespace stackabilization;
using namespace stackabilization::apps;

namespace {

editing::Document table_document() {
  return editing::new_document(structures::table(1));
}

std::string refusal_of(const std::string& command) {
  const StructuredShape table = structures::table(1);
  return message_of<UsageError>([&] { page_command(Json::parse(command), table); });
}

/// A room that serves, whose next file fails to open as `failure` says.
class Served {
 public:
  explicit Served(std::function<void()> failure) {
    RoomOptions options;
    options.open = [failure = std::move(failure)](const std::string&, const std::string&) -> DroppedModel {
      failure();
      return {};
    };
    WebOptions web;
    web.keep_open = true;
    room_.emplace(table_document(), std::move(options), web);
    thread_ = std::thread([this] { room_->run(); });
  }
  ~Served() {
    std::raise(SIGTERM);  // as a person ends it
    thread_.join();
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  /// The answer to one request, with its head.
  std::string answer(const std::string& method, const std::string& path, const std::string& body) const {
    const std::string address = room_->address(), host = address.substr(7, address.find('/', 7) - 7),
                      folder = address.substr(7 + host.size());
    boost::asio::io_context context;
    boost::asio::ip::tcp::socket socket(context);
    const auto port = static_cast<unsigned short>(std::stoi(host.substr(host.find(':') + 1)));
    socket.connect({boost::asio::ip::address_v4::loopback(), port});
    boost::asio::write(socket, boost::asio::buffer(method + " " + folder + path +
                                                   " HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" +
                                                   host + "\r\nConnection: close\r\nContent-Length: " +
                                                   std::to_string(body.size()) + "\r\n\r\n" + body));
    std::string text;
    boost::system::error_code end;
    boost::asio::read(socket, boost::asio::dynamic_buffer(text), end);
    return text;
  }

 private:
  std::optional<EditingRoom> room_;
  std::thread thread_;
};

/// A study of one task, of which nothing can be written down until there is a folder for it.
StudyOptions study_in(const std::filesystem::path& folder) {
  StudyOptions study;
  study.plan.tasks = {{.name = "table", .model = "table.obj", .target = 0.3, .without = {}}};
  study.results = folder / "results.csv";
  study.open = [](const editing::StudyPlanTask&) { return table_document(); };
  return study;
}

}  // namespace

TEST_CASE("rows that no int holds are refused, not cut off") {
  for (const char* row : {"4294967296", "2147483648", "-1", "18446744073709551615", "1.5", "\"0\""}) {
    INFO(row);
    const std::string list = std::string("[0, ") + row + "]}";
    CHECK(mentions(refusal_of("{\"do\": \"keep\", \"parts\": " + list), "counted from 0"));
    CHECK(mentions(refusal_of("{\"do\": \"join\", \"parts\": " + list), "counted from 0"));
    CHECK(
        mentions(refusal_of(std::string("{\"do\": \"apply\", \"number\": ") + row + "}"), "counted from 0"));
  }
  const editing::Command keep =
      page_command(Json::parse(R"({"do": "keep", "parts": [2147483647]})"), structures::table(1));
  CHECK(std::get<editing::KeepParts>(keep).parts == std::vector<int>{2147483647});
}

TEST_CASE("the program holds the files of its page as they are now") {
  const std::filesystem::path folder =
      std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "apps/editor/page";
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    INFO(entry.path());
    const auto embedded = page_file(std::filesystem::relative(entry.path(), folder).generic_string());
    REQUIRE(embedded);
    CHECK(embedded->bytes == read_file(entry.path()));
    ++files;
  }
  CHECK(files > 10);
  CHECK_FALSE(page_file("none.js"));
}

TEST_CASE("whatever fails is told in words for people, and the program goes on") {
  const auto [failure, words] = GENERATE(table<std::function<void()>, std::string>(
      {{[] { throw std::bad_alloc(); }, "this takes more memory than there is"},
       {[] { throw std::length_error("vector"); }, "unexpected failure: vector"},
       {[] { throw InputError("no mesh"); }, "no mesh"}}));
  const Served served(failure);
  CHECK(mentions(served.answer("POST", "open?name=a.obj", "v 0 0 0"), words));
  CHECK(mentions(served.answer("GET", "export/obj", ""), "HTTP/1.1 200"));
}

TEST_CASE("a task that cannot be written down has not begun, and can be begun again") {
  const test::ScratchFolder scratch("editor_study");
  const std::filesystem::path folder = scratch.path() / "results";
  StudyDesk desk(study_in(folder));
  editing::EditingSession session(table_document(), {}, nullptr);
  const Json agree = {{"do", "study"}, {"step", "agree"}};
  CHECK_THROWS_AS(desk.step(agree, session), OutputError);
  CHECK(desk.state()["phase"] == "consent");
  std::filesystem::create_directory(folder);
  std::filesystem::create_directory(folder / "results.csv");  // is there, and no file
  CHECK_THROWS_AS(desk.step(agree, session), OutputError);
  CHECK(desk.state()["phase"] == "consent");
  std::filesystem::remove(folder / "results.csv");
  desk.step(agree, session);
  CHECK(desk.state()["phase"] == "task");
  CHECK(mentions(read_file(folder / "results.csv"), "begin"));
}

TEST_CASE("suggestions are looked for only where a task is done with them") {
  const test::ScratchFolder scratch("editor_conditions");
  StudyOptions study = study_in(scratch.path());
  study.participant = GENERATE(1, 2, 3);
  const editing::StudyCondition condition = editing::study_turns(study.participant, 1).front().condition;
  StudyDesk desk(std::move(study));
  editing::EditingSession session(table_document(), {}, nullptr);
  desk.step({{"do", "study"}, {"step", "agree"}}, session);
  while (const auto job = session.next_job(editing::Lane::advice))
    (*job)([](const editing::EditingSession::Result& result) { result(); });
  CHECK(session.review());
  CHECK(session.suggestions().empty() == (condition != editing::StudyCondition::suggestive));
}

TEST_CASE("an answer is a number from 1 to 5, to the last digit") {
  const test::ScratchFolder scratch("editor_answers");
  StudyDesk desk(study_in(scratch.path()));
  editing::EditingSession session(table_document(), {}, nullptr);
  desk.step({{"do", "study"}, {"step", "agree"}}, session);
  desk.step({{"do", "study"}, {"step", "give up"}}, session);
  for (const char* answer : {"4294967297", "0", "6", "1.0"}) {
    const Json answers = Json::parse(std::string("[1, 2, ") + answer + "]");
    CHECK_THROWS_AS(desk.step({{"do", "study"}, {"step", "answers"}, {"answers", answers}}, session),
                    UsageError);
  }
  desk.step({{"do", "study"}, {"step", "answers"}, {"answers", {1, 2, 5}}}, session);
  CHECK(desk.state()["phase"] == "done");
}

TEST_CASE("a session file is had by one program, until it lets go or is killed") {
  const test::ScratchFolder scratch("editor_locks");
  const std::filesystem::path file = scratch.path() / "chair.obj.session.json";
  // A lock belongs to who has opened the file: two of these are as two programs.
  SessionLocks one, other;
  SessionLock first = one.take(file);
  const SessionLock again = one.take(scratch.path() / "." / "chair.obj.session.json");
  CHECK(again == first);
  CHECK(mentions(message_of<UsageError>([&] { other.take(file); }), "another program edits"));
  CHECK(other.take(scratch.path() / "cup.obj.session.json"));
  first.reset();
  CHECK_THROWS_AS(other.take(file), UsageError);
}

TEST_CASE("a session that was let go is free, also where a killed program left its lock behind") {
  const test::ScratchFolder scratch("editor_free_locks");
  const std::filesystem::path file = scratch.path() / "chair.obj.session.json";
  SessionLocks one, other;
  one.take(file).reset();
  CHECK(std::filesystem::is_empty(scratch.path()));
  std::ofstream(file.string() + ".lock") << "";
  CHECK(other.take(file));
  CHECK(!one.take({}));
  CHECK(one.take(scratch.path() / "nowhere" / "chair.obj.session.json"));  // nothing can be saved there
}
