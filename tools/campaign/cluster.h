// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_CLUSTER_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_CLUSTER_H_

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "touchstone/tools/campaign/workers.h"

struct TouchstoneMpiFunctions;

namespace touchstone {

// The processes of one job started by mpirun or srun.
class Cluster {
 public:
  // Whether this process was started as part of a job.
  static bool IsJob();
  // Joins it. Throws BadInput where the project was configured without MPI.
  static std::unique_ptr<Cluster> Join();

  int rank() const { return rank_; }
  int size() const { return size_; }
  // False when the rank is known to be gone.
  bool Send(int rank, std::string_view text) const;
  struct Message {
    int from;
    std::string text;
    bool is_whole;  // false: its sender went away while it was sent
  };
  std::optional<Message> TryReceive() const;
  // The last call. Not in order, since ranks that are gone would be waited for: rank 0 ends the job,
  // any other rank ends at once.
  void Leave(bool in_order, int exit_code) const;

 private:
  const TouchstoneMpiFunctions* functions_ = nullptr;
  int rank_ = 0, size_ = 1;
};

// Rank 0: its own workers and those of all other ranks, which take batches as they become free. A
// rank that cannot be reached, or that says nothing for `silence_seconds`, is given up: its batches
// are handed out again, and whichever result comes first counts.
class ClusterWorkers : public Workers {
 public:
  ClusterWorkers(const Cluster& cluster, std::unique_ptr<Workers> local,
                 double silence_seconds = 120.0);
  ~ClusterWorkers() override;

  int Free() const override;
  void Give(const Batch& batch) override;
  std::vector<BatchResult> Collect(double seconds) override;
  int Running() const override;
  // Tells the other ranks to end. Returns whether none was given up.
  bool Dismiss();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// Other ranks: runs what rank 0 sends until it says that all is done. False where a rank is lost.
bool ServeRank(const Cluster& cluster, Workers& local);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_CLUSTER_H_
