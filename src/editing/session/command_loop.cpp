#include "stackabilization/editing/command_loop.h"

#include <array>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace stackabilization::editing {

class CommandLoop::Implementation {
 public:
  explicit Implementation(std::unique_ptr<EditingSession> session) : session_(std::move(session)) {
    for (const Lane lane : {Lane::advice, Lane::automatic})
      workers_[static_cast<std::size_t>(lane)] = std::thread([this, lane] { work(lane); });
    commands_ = std::thread([this] { execute(); });
  }

  ~Implementation() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
      tasks_.clear();
    }
    changed_.notify_all();
    commands_.join();
    session_->cancel();
    for (std::thread& worker : workers_) worker.join();
  }

  /// `dragger`: the source of a drag.
  void post(Task task, std::optional<std::uint64_t> dragger = {}) {
    {
      const std::lock_guard lock(mutex_);
      if (ended_) return;
      if (dragger && !tasks_.empty() && tasks_.back().dragger == dragger) tasks_.pop_back();
      tasks_.push_back({std::move(task), dragger});
    }
    changed_.notify_all();
  }

 private:
  struct Waiting {
    Task task;
    std::optional<std::uint64_t> dragger;
  };

  /// The thread of the session.
  void execute() {
    std::unique_lock lock(mutex_);
    while (true) {
      for (const Lane lane : {Lane::advice, Lane::automatic})
        if (std::optional<EditingSession::Job>& job = jobs_[static_cast<std::size_t>(lane)]; !job)
          job = session_->next_job(lane);
      changed_.notify_all();
      changed_.wait(lock, [this] { return ended_ || !tasks_.empty(); });
      if (ended_) return;
      const Task task = std::move(tasks_.front().task);
      tasks_.pop_front();
      lock.unlock();
      task(*session_);
      lock.lock();
    }
  }

  /// A thread of a lane.
  void work(Lane lane) {
    std::optional<EditingSession::Job>& next = jobs_[static_cast<std::size_t>(lane)];
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return ended_ || next; });
      if (ended_) return;
      const EditingSession::Job job = std::move(*next);
      next.reset();
      lock.unlock();
      job([this](EditingSession::Result result) {
        post([result = std::move(result)](EditingSession&) { result(); });
      });
      lock.lock();
    }
  }

  std::unique_ptr<EditingSession> session_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> tasks_;
  std::array<std::optional<EditingSession::Job>, 2> jobs_;
  bool ended_ = false;
  std::array<std::thread, 2> workers_;
  std::thread commands_;
};

CommandLoop::CommandLoop(std::unique_ptr<EditingSession> session)
    : implementation_(std::make_unique<Implementation>(std::move(session))) {}

CommandLoop::~CommandLoop() = default;

void CommandLoop::post(Task task) {
  implementation_->post(std::move(task));
}

void CommandLoop::post_drag(Task task, std::uint64_t source) {
  implementation_->post(std::move(task), source);
}

}  // namespace stackabilization::editing
