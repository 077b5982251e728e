// SPDX-License-Identifier: MIT
//
// Messages between ranks: "free N" once from a rank, how many batches it runs at a time; "alive"
// now and then; a batch to it; a result from it; "end" to it, or "leave" where a rank is lost.
#include "touchstone/tools/campaign/cluster.h"

#include <dlfcn.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "touchstone/tools/bad_input.h"
#include "touchstone/tools/campaign/mpi_module.h"
#include "touchstone/tools/numbers.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kEnd = "end", kLeave = "leave", kAlive = "alive", kFree = "free ";
constexpr double kAliveSeconds = 2.0;
// A message is a few kilobytes: what is not whole by then never will be.
constexpr double kMessageSeconds = 10.0;
// How long a look at one side may keep the other waiting.
constexpr double kGlance = 0.005;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

bool Cluster::IsJob() {
  // Open MPI; MPICH and srun; PMIx.
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

std::unique_ptr<Cluster> Cluster::Join() {
#ifdef TOUCHSTONE_MPI_MODULE
  // Open MPI's own plugins look for its symbols in the global name space.
  void* module = dlopen(TOUCHSTONE_MPI_MODULE, RTLD_NOW | RTLD_GLOBAL);
  if (module == nullptr) throw BadInput{std::string("MPI: ") + dlerror()};
  auto cluster = std::make_unique<Cluster>();
  cluster->functions_ = static_cast<const TouchstoneMpiFunctions*>(dlsym(module, "touchstone_mpi"));
  if (cluster->functions_ == nullptr ||
      !cluster->functions_->start(&cluster->rank_, &cluster->size_)) {
    throw BadInput{"MPI: the job cannot be joined"};
  }
  return cluster;
#else
  throw BadInput{"MPI: libopenmpi-dev was not found when the project was configured"};
#endif
}

bool Cluster::Send(int rank, std::string_view text) const {
  return functions_->send(rank, text.data(), static_cast<int>(text.size()));
}

std::optional<Cluster::Message> Cluster::TryReceive() const {
  Message message;
  const int size = functions_->probe(&message.from);
  if (size < 0) return std::nullopt;
  message.text.resize(static_cast<std::size_t>(size));
  message.is_whole = functions_->receive(message.from, message.text.data(), size, kMessageSeconds);
  return message;
}

void Cluster::Leave(bool in_order, int exit_code) const {
  if (!in_order && rank_ > 0) std::_Exit(exit_code);
  functions_->finish(in_order, exit_code);
}

class ClusterWorkers::Impl {
 public:
  Impl(const Cluster& cluster, std::unique_ptr<Workers> local, double silence_seconds)
      : cluster_(cluster),
        local_(std::move(local)),
        silence_seconds_(silence_seconds),
        ranks_(static_cast<std::size_t>(cluster.size())) {}

  int Free() const {
    int free = local_->Free() - static_cast<int>(orphans_.size());
    for (const Rank& rank : ranks_) free += FreeOf(rank);
    return std::max(0, free);
  }

  int Running() const {
    return static_cast<int>(handed_.size() + orphans_.size()) + local_->Running();
  }

  void Give(const Batch& batch) {
    for (std::size_t r = 1; r < ranks_.size(); ++r) {
      if (FreeOf(ranks_[r]) == 0) continue;
      if (cluster_.Send(static_cast<int>(r), ToText(batch, {}))) {
        handed_[batch] = r;
        ++ranks_[r].running;
        return;
      }
      GiveUp(r);
    }
    if (local_->Free() > 0) {
      local_->Give(batch);
    } else {
      orphans_.push_back(batch);
    }
  }

  std::vector<BatchResult> Collect(double seconds) {
    const Clock::time_point start = Clock::now();
    std::vector<BatchResult> results;
    do {
      while (const auto message = cluster_.TryReceive()) Take(*message, results);
      for (BatchResult& result : local_->Collect(kGlance)) results.push_back(std::move(result));
      LookForSilence();
      Rehand();
    } while (results.empty() && SecondsSince(start) < seconds);
    return results;
  }

  bool Dismiss() {
    const bool all_there =
        std::none_of(ranks_.begin() + 1, ranks_.end(), [](const Rank& r) { return r.gone; });
    for (std::size_t r = 1; r < ranks_.size(); ++r) {
      if (!ranks_[r].gone) cluster_.Send(static_cast<int>(r), all_there ? kEnd : kLeave);
    }
    return all_there;
  }

 private:
  struct Rank {
    int slots = 0, running = 0;
    bool gone = false;
    Clock::time_point heard = Clock::now();
  };

  static int FreeOf(const Rank& rank) {
    return rank.gone ? 0 : std::max(0, rank.slots - rank.running);
  }

  void Take(const Cluster::Message& message, std::vector<BatchResult>& results) {
    Rank& rank = ranks_[static_cast<std::size_t>(message.from)];
    if (!message.is_whole) return GiveUp(static_cast<std::size_t>(message.from));
    rank.heard = Clock::now();
    if (message.text == kAlive) return;
    if (message.text.starts_with(kFree)) {
      rank.slots = ParseInteger<int>(message.text.substr(kFree.size())).value_or(0);
      return;
    }
    rank.running = std::max(0, rank.running - 1);
    BatchResult result = BatchResultFromText(message.text);
    // From a rank that was given up, it may have been handed out again and come back already.
    const auto orphan = std::find(orphans_.begin(), orphans_.end(), result.batch);
    if (orphan != orphans_.end()) {
      orphans_.erase(orphan);
    } else if (handed_.erase(result.batch) == 0) {
      return;
    }
    results.push_back(std::move(result));
  }

  void LookForSilence() {
    for (std::size_t r = 1; r < ranks_.size(); ++r) {
      if (!ranks_[r].gone && SecondsSince(ranks_[r].heard) > silence_seconds_) GiveUp(r);
    }
  }

  void GiveUp(std::size_t r) {
    ranks_[r].gone = true;
    for (auto it = handed_.begin(); it != handed_.end();) {
      if (it->second == r) orphans_.push_back(it->first);
      it = it->second == r ? handed_.erase(it) : std::next(it);
    }
  }

  // Orphans go to other ranks only: a batch of this rank's own is not listed in `handed_`, and a
  // late result could count twice. The last resort is this rank, once no other is there.
  void Rehand() {
    while (!orphans_.empty()) {
      const bool some_rank =
          std::any_of(ranks_.begin() + 1, ranks_.end(), [](const Rank& r) { return !r.gone; });
      const bool some_free = std::any_of(ranks_.begin() + 1, ranks_.end(),
                                         [](const Rank& r) { return FreeOf(r) > 0; });
      if (some_rank ? !some_free : local_->Free() == 0) return;
      const Batch batch = orphans_.back();
      orphans_.pop_back();
      Give(batch);
    }
  }

  const Cluster& cluster_;
  std::unique_ptr<Workers> local_;
  double silence_seconds_;
  std::vector<Rank> ranks_;
  std::map<Batch, std::size_t> handed_;  // to which rank
  std::vector<Batch> orphans_;           // of ranks given up
};

ClusterWorkers::ClusterWorkers(const Cluster& cluster, std::unique_ptr<Workers> local,
                               double silence_seconds)
    : impl_(std::make_unique<Impl>(cluster, std::move(local), silence_seconds)) {}
ClusterWorkers::~ClusterWorkers() = default;
int ClusterWorkers::Free() const { return impl_->Free(); }
void ClusterWorkers::Give(const Batch& batch) { impl_->Give(batch); }
std::vector<BatchResult> ClusterWorkers::Collect(double seconds) { return impl_->Collect(seconds); }
int ClusterWorkers::Running() const { return impl_->Running(); }
bool ClusterWorkers::Dismiss() { return impl_->Dismiss(); }

bool ServeRank(const Cluster& cluster, Workers& local) {
  cluster.Send(0, std::string(kFree) + std::to_string(local.Free()));
  Clock::time_point said = Clock::now();
  bool ends = false;
  std::vector<Batch> waiting;
  while (!ends || local.Running() > 0 || !waiting.empty()) {
    while (const auto message = cluster.TryReceive()) {
      if (!message->is_whole || message->text == kLeave) return false;
      if (message->text == kEnd) {
        ends = true;
        continue;
      }
      Batch batch;
      std::vector<FatalQuery> none;
      FromText(message->text, batch, none);
      waiting.push_back(batch);
    }
    while (!waiting.empty() && local.Free() > 0) {
      local.Give(waiting.back());
      waiting.pop_back();
    }
    for (const BatchResult& result : local.Collect(kGlance)) {
      if (!cluster.Send(0, ToText(result))) return false;
      said = Clock::now();
    }
    if (SecondsSince(said) > kAliveSeconds) {
      if (!cluster.Send(0, kAlive)) return false;
      said = Clock::now();
    }
  }
  return true;
}

}  // namespace touchstone
