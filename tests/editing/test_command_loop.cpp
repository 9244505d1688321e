#include <future>
#include <thread>

#include "sessions.h"
#include "stackabilization/editing/command_loop.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::editing;

namespace {

std::unique_ptr<EditingSession> table_session(Listener listener = nullptr) {
  return std::make_unique<EditingSession>(sessions::table_document(), SessionOptions(), std::move(listener));
}

}  // namespace

TEST_CASE("tasks run one after the other, in their order") {
  std::vector<int> order;
  std::promise<void> done;
  {
    CommandLoop loop(table_session());
    for (int k = 0; k < 100; ++k) loop.post([&order, k](EditingSession&) { order.push_back(k); });
    loop.post([&](EditingSession&) { done.set_value(); });
    done.get_future().wait();
  }
  REQUIRE(order.size() == 100);
  for (int k = 0; k < 100; ++k) CHECK(order[static_cast<std::size_t>(k)] == k);
}

TEST_CASE("of drags that wait only the last one is made") {
  std::vector<int> made;
  std::promise<void> posted, done;
  CommandLoop loop(table_session());
  loop.post([&](EditingSession&) { posted.get_future().wait(); });
  for (int k = 0; k < 100; ++k) loop.post_drag([&made, k](EditingSession&) { made.push_back(k); }, 7);
  loop.post([](EditingSession&) {});
  for (int k = 100; k < 200; ++k) loop.post_drag([&made, k](EditingSession&) { made.push_back(k); }, 7);
  loop.post([&](EditingSession&) { done.set_value(); });
  posted.set_value();
  done.get_future().wait();
  CHECK(made == std::vector<int>{99, 199});
}

TEST_CASE("a drag takes the place of none from another source") {
  std::vector<int> made;
  std::promise<void> posted, done;
  CommandLoop loop(table_session());
  loop.post([&](EditingSession&) { posted.get_future().wait(); });
  for (const int source : {1, 1, 2, 1, 2, 2})
    loop.post_drag([&made, source](EditingSession&) { made.push_back(source); },
                   static_cast<std::uint64_t>(source));
  loop.post([&](EditingSession&) { done.set_value(); });
  posted.set_value();
  done.get_future().wait();
  CHECK(made == std::vector<int>{1, 2, 1, 2});
}

TEST_CASE("suggestions come without being asked for, on the thread of the session") {
  std::promise<std::thread::id> complete;
  bool said = false;
  std::thread::id other;
  {
    CommandLoop loop(table_session([&](const Event& event) {
      const auto* progress = std::get_if<Progress>(&event);
      if (!progress || progress->work != Work::suggestions || progress->fraction < 1 || said) return;
      said = true;
      complete.set_value(std::this_thread::get_id());
    }));
    std::promise<std::thread::id> own;
    loop.post([&](EditingSession&) { own.set_value(std::this_thread::get_id()); });
    other = own.get_future().get();
    CHECK(complete.get_future().get() == other);
  }
  CHECK(other != std::this_thread::get_id());
}

TEST_CASE("a loop ends while jobs run") {
  CommandLoop loop(table_session());
  loop.post([](EditingSession& session) { session.execute(FindDesigns{}); });
}
