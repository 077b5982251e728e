// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/workers.h"

#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <csignal>
#include <cstring>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include "touchstone/tools/campaign/pipes.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

// Where a child is; in memory that both see.
struct Position {
  std::atomic<std::uint64_t> steps;  // grows with every step
  std::atomic<std::uint64_t> index;
  std::atomic<int> contestant;
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

[[noreturn]] void ServeBatches(const CampaignPlan& plan, int in, int out, Position& position) {
  // The terminal's signals are the parent's; its death is the child's.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // A crash is a finding, not a file.
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const SayPosition say = [&](std::uint64_t index, int contestant) {
    position.index.store(index, std::memory_order_relaxed);
    position.contestant.store(contestant, std::memory_order_relaxed);
    position.steps.fetch_add(1, std::memory_order_release);
  };
  BatchRunner runner(plan);
  std::string message;
  while (ReadMessage(in, message)) {
    Batch batch;
    std::vector<FatalQuery> fatal;
    FromText(message, batch, fatal);
    if (!WriteMessage(out, ToText(runner.Run(batch, fatal, say)))) break;
  }
  // Not exit(): nothing of the parent's is to be flushed or destroyed here.
  _exit(0);
}

struct Child {
  pid_t pid = -1;
  int to = -1, from = -1;
  Position* position = nullptr;
  std::optional<Batch> batch;
  std::vector<FatalQuery> fatal;
  std::string received;
  std::uint64_t steps = 0;       // when last looked
  Clock::time_point moved = {};  // when `steps` last changed
};

class LocalWorkers : public Workers {
 public:
  LocalWorkers(const CampaignPlan& plan, int count, double hang_seconds)
      : plan_(plan), hang_seconds_(hang_seconds), children_(static_cast<std::size_t>(count)) {
    // A child that is gone is seen by what its pipe says.
    std::signal(SIGPIPE, SIG_IGN);
    for (Child& child : children_) {
      void* memory = mmap(nullptr, sizeof(Position), PROT_READ | PROT_WRITE,
                          MAP_SHARED | MAP_ANONYMOUS, -1, 0);
      if (memory == MAP_FAILED) throw std::runtime_error("no shared memory for a worker");
      child.position = new (memory) Position{};
      Start(child);
    }
  }

  ~LocalWorkers() override {
    for (Child& child : children_) {
      if (child.pid > 0) kill(child.pid, SIGKILL);
      Bury(child);
      munmap(child.position, sizeof(Position));
    }
  }

  int Free() const override {
    return static_cast<int>(std::count_if(children_.begin(), children_.end(),
                                          [](const Child& child) { return !child.batch; }));
  }

  int Running() const override { return static_cast<int>(children_.size()) - Free(); }

  void Give(const Batch& batch) override {
    for (Child& child : children_) {
      if (child.batch) continue;
      child.batch = batch;
      child.fatal.clear();
      Send(child);
      return;
    }
    assert(false);
  }

  std::vector<BatchResult> Collect(double seconds) override {
    std::vector<pollfd> pipes;
    for (const Child& child : children_) pipes.push_back({child.from, POLLIN, 0});
    poll(pipes.data(), pipes.size(), static_cast<int>(1000.0 * seconds));
    std::vector<BatchResult> results;
    for (std::size_t i = 0; i < children_.size(); ++i) {
      Child& child = children_[i];
      if (pipes[i].revents != 0) Receive(child, results);
      if (child.batch && HasHung(child)) {
        if (child.pid > 0) kill(child.pid, SIGKILL);
        Replace(child, "hang", "no answer");
      }
    }
    return results;
  }

 private:
  void Start(Child& child) {
    int to[2], from[2];
    if (pipe(to) != 0 || pipe(from) != 0) throw std::runtime_error("no pipe for a worker");
    const pid_t parent = getpid();
    child.pid = fork();
    if (child.pid < 0) throw std::runtime_error("no process for a worker");
    if (child.pid == 0) {
      close(to[1]);
      close(from[0]);
      // Other children's pipes must close with this process alone.
      for (const Child& other : children_) {
        if (other.to >= 0) close(other.to);
        if (other.from >= 0) close(other.from);
      }
      if (getppid() != parent) _exit(0);
      try {
        ServeBatches(plan_, to[0], from[1], *child.position);
      } catch (...) {
        // Nothing of the parent's may be unwound here: its destructors end its children.
        _exit(1);
      }
    }
    close(to[0]);
    close(from[1]);
    child.to = to[1];
    child.from = from[0];
    child.received.clear();
    child.moved = Clock::now();
  }

  static void Send(Child& child) {
    child.moved = Clock::now();
    // Should the child be gone, its other pipe says so.
    WriteMessage(child.to, ToText(*child.batch, child.fatal));
  }

  void Receive(Child& child, std::vector<BatchResult>& results) {
    if (!ReadSome(child.from, child.received)) {
      const int status = Bury(child);
      const bool signalled = WIFSIGNALED(status);
      const int number = signalled ? WTERMSIG(status) : WEXITSTATUS(status);
      Restart(child, "crash",
              signalled
                  ? "ended by signal " + std::to_string(number) + " (" + strsignal(number) + ")"
                  : "exited with code " + std::to_string(number));
      return;
    }
    if (const auto message = TakeMessage(child.received)) {
      results.push_back(BatchResultFromText(*message));
      child.batch.reset();
    }
  }

  bool HasHung(Child& child) const {
    const std::uint64_t steps = child.position->steps.load(std::memory_order_acquire);
    const Clock::time_point now = Clock::now();
    if (steps != child.steps) {
      child.steps = steps;
      child.moved = now;
    }
    return std::chrono::duration<double>(now - child.moved).count() > hang_seconds_;
  }

  void Replace(Child& child, const std::string& kind, const std::string& detail) {
    Bury(child);
    Restart(child, kind, detail);
  }

  // Requires a buried child. Its batch, if any, is run again but for the query that ended it.
  void Restart(Child& child, const std::string& kind, const std::string& detail) {
    if (child.batch) {
      const FatalQuery fatal{child.position->index.load(), child.position->contestant.load(), kind,
                             detail};
      for (const FatalQuery& known : child.fatal) {
        if (known.index == fatal.index && known.contestant == fatal.contestant)
          throw std::runtime_error("a worker ends at a query that it does not ask: " + detail);
      }
      child.fatal.push_back(fatal);
    }
    Start(child);
    if (child.batch) Send(child);
  }

  static int Bury(Child& child) {
    int status = 0;
    if (child.pid > 0) waitpid(child.pid, &status, 0);
    child.pid = -1;
    close(child.to);
    close(child.from);
    child.to = child.from = -1;
    return status;
  }

  const CampaignPlan& plan_;
  double hang_seconds_;
  std::vector<Child> children_;
};

}  // namespace

std::unique_ptr<Workers> MakeLocalWorkers(const CampaignPlan& plan, int count,
                                          double hang_seconds) {
  return std::make_unique<LocalWorkers>(plan, count, hang_seconds);
}

}  // namespace touchstone
