#include "threads/parallel_tasks.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace isostar {
namespace {

unsigned wanted = 0;

unsigned threadCount() {
  return wanted != 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

/// The threads of one call of runInParallel(), and of the calls that its tasks make.
class Crew {
 public:
  /// `most`: threads beside the one that makes it.
  explicit Crew(size_t most) : most_(most) {}
  ~Crew() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  Crew(const Crew&) = delete;

  /// The crew that the calling thread works in; null if there is none.
  static Crew*& current() {
    thread_local Crew* crew = nullptr;
    return crew;
  }
  /// Makes the calling thread one of a crew.
  struct Member {
    explicit Member(Crew& crew) { current() = &crew; }
    ~Member() { current() = nullptr; }
    Member(const Member&) = delete;
  };

  /// Returns when all tasks have. A thread that waits for the last ones takes tasks that these have
  /// called for, and no others, which could take longer. Throws the first exception of a task.
  void run(size_t tasks, const std::function<void(size_t)>& work) {
    std::unique_lock lock(mutex_);
    Call call{tasks, &work, ++calls_};
    open_.push_back(&call);
    for (size_t i = idle_ + 1; i < tasks && threads_.size() < most_; ++i)
      threads_.emplace_back([this] { help(); });
    changed_.notify_all();
    while (call.returned < call.tasks) {
      if (!open_.empty() && open_.back()->number >= call.number)
        runNext(lock);
      else
        changed_.wait(lock);
    }
    if (call.thrown) std::rethrow_exception(call.thrown);
  }

 private:
  struct Call {
    size_t tasks;
    const std::function<void(size_t)>* work;
    uint64_t number;
    size_t next = 0, returned = 0;
    std::exception_ptr thrown{};
  };

  void help() {
    const Member member(*this);
    std::unique_lock lock(mutex_);
    while (!done_) {
      if (!open_.empty()) {
        runNext(lock);
        continue;
      }
      ++idle_;
      changed_.wait(lock);
      --idle_;
    }
  }

  /// Runs a task of the latest call.
  void runNext(std::unique_lock<std::mutex>& lock) {
    Call& call = *open_.back();
    const size_t task = call.next++;
    if (call.next == call.tasks) open_.pop_back();
    lock.unlock();
    std::exception_ptr thrown;
    try {
      (*call.work)(task);
    } catch (...) {
      thrown = std::current_exception();
    }
    lock.lock();
    if (thrown && !call.thrown) call.thrown = thrown;
    if (++call.returned == call.tasks) changed_.notify_all();
  }

  const size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Call*> open_;  // with tasks that nobody has taken
  uint64_t calls_ = 0;
  size_t idle_ = 0;  // threads that wait for a call
  bool done_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace

void useThreads(unsigned count) {
  wanted = count;
}

void runInParallel(size_t tasks, const std::function<void(size_t)>& work) {
  if (tasks == 0) return;
  if (Crew::current() != nullptr) return Crew::current()->run(tasks, work);
  Crew crew(threadCount() - 1);
  const Crew::Member member(crew);
  crew.run(tasks, work);
}

RunTasks parallelTasks() {
  return threadCount() > 1 ? RunTasks(runInParallel) : RunTasks();
}

}  // namespace isostar
