// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_SCENE_SCENE_H_
#define TOUCHSTONE_CORE_SCENE_SCENE_H_

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/base/status.h"
#include "touchstone/core/base/verdict.h"
#include "touchstone/core/cpd/continuous_penetration_depth.h"
#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/mesh/surface_distance.h"
#include "touchstone/core/mesh/surface_travel.h"
#include "touchstone/core/proximity/result.h"
#include "touchstone/core/scene/options.h"
#include "touchstone/core/scene/shape.h"

namespace touchstone {

// Names a body of one scene. A handle of a body that was removed names nothing, even when its slot
// is in use again.
struct BodyHandle {
  std::uint32_t slot = ~std::uint32_t{0};
  std::uint32_t generation = 0;
  friend auto operator<=>(const BodyHandle&, const BodyHandle&) = default;
};

// a.slot < b.slot, always.
struct BodyPair {
  BodyHandle a, b;
  friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

enum class EventKind {
  kBegin,    // they touch or overlap, and did not after the step before
  kPersist,  // they did, and do
  kEnd,      // they did, and do not, or one of them was removed
};
std::string_view ToString(EventKind);

struct SceneEvent {
  EventKind kind;
  BodyPair bodies;
  Verdict verdict;  // of the step: kTouch, kOverlap; kSeparate for kEnd
  friend bool operator==(const SceneEvent&, const SceneEvent&) = default;
};

// A number for two parts: P is the part of body a, Q that of body b, and the result is in P's
// frame, as the header that defines it says; A and B there are P and Q.
template <class Result>
struct SceneNumber {
  BodyPair bodies;
  int part_a = 0, part_b = 0;
  Result result;
};

// What a step found: valid until the scene's next call that is not const. All lists are ordered by
// the bodies' slots, then by parts, whatever the number of threads and the rules.
struct SceneStep {
  std::span<const SceneEvent> events;
  // Where the distance is at most the margin; of compounds each pair of parts by itself. Zero for
  // bodies that meet (kMeet).
  std::span<const SceneNumber<DistanceResult>> distances;
  // The same where one part is a mesh at least: zero, and no faces, for bodies that meet.
  std::span<const SceneNumber<SurfaceDistanceResult>> mesh_distances;
  // Of parts that overlap: how far to move one body so that these two parts just touch.
  std::span<const SceneNumber<PenetrationResult>> depths;
  // The same where one part is a mesh at least.
  std::span<const SceneNumber<MeshDepthResult>> mesh_depths;
  // Of parts that overlap, convex or not: it follows their motion from the step on that began the
  // overlap, an answer at each step that moves them. Branches are numbered from 1 at that step.
  std::span<const SceneNumber<ContinuousDepthResult>> continuous_depths;
  // Of parts whose travel begins within the reach. Q travels along the direction; where body a was
  // subscribed and travels, Q travels against it.
  std::span<const SceneNumber<DirectionalResult>> travels;
  // The same where one part is a mesh at least: until they first meet. Zero, and no faces, for
  // bodies that meet already.
  std::span<const SceneNumber<SurfaceTravelResult>> mesh_travels;
  SceneCounters counters;
};

// Many placed bodies. Each step answers for every two bodies what was subscribed to, and does no
// more than that takes.
//
// Verdicts are those of the closed bodies at their exact poses, as Collide and Membership define
// and prove them; a compound overlaps where any of its parts does, and touches where any touches
// and none overlaps. Skipping changes no verdict, no event and no list; numbers stay within their
// own bounds. Nothing throws. A call with bad data returns a status and leaves the scene as it was.
// Not for several threads at once; scenes share shapes freely.
//
// Complexity of a step: O(m) for m bodies that moved, and a few loads for every pair whose boxes
// are near, plus the pairs that must be looked at; O(1) where no body has moved.
class Scene {
 public:
  explicit Scene(const SceneOptions& options = {});
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  // The new body, or why its pose will not do: kNonFinite, kOutOfRange (a translation above
  // 2.5e99), kBadRotation, naming the row; kOutOfRange for subscriptions with a margin or a reach
  // that is negative or not finite, or a direction whose length is not within [1e-100, 1e100].
  StatusOr<BodyHandle> Add(const SceneShape& shape, const WorldPose& pose,
                           const Subscriptions& subscriptions = {}, const Filter& filter = {});
  // Contacts of the body end with the next step. kBadIndex for a handle that names nothing, here
  // and below.
  Status Remove(BodyHandle body);
  Status Move(BodyHandle body, const WorldPose& pose);

  // Replaces what a body is subscribed to.
  Status Subscribe(BodyHandle body, const Subscriptions& subscriptions);
  // The same of a pair, besides what its bodies are; `verdict` false and nothing else: forgets it.
  // kBadIndex for a body with itself.
  Status SubscribePair(BodyHandle a, BodyHandle b, const Subscriptions& subscriptions);
  Status SetFilter(BodyHandle body, const Filter& filter);
  // The two bodies pass through each other from the next step on; or no longer do.
  Status SetIgnored(BodyHandle a, BodyHandle b, bool ignored);

  // Brings everything up to date with the poses.
  SceneStep Step();

  bool Has(BodyHandle body) const;
  int body_count() const;
  // Requires Has(body).
  const WorldPose& pose(BodyHandle body) const;
  const SceneShape& shape(BodyHandle body) const;
  // All bodies, by slots.
  std::vector<BodyHandle> bodies() const;
  // Whether the two meet, after the last step; kSeparate for pairs without a verdict subscription.
  Verdict verdict(BodyHandle a, BodyHandle b) const;

  const SceneOptions& options() const;

  struct Memory {
    std::size_t bodies = 0;      // hot arrays, poses, boxes and the broad phase
    std::size_t pairs = 0;       // the table
    std::size_t mesh_pairs = 0;  // meshes placed for pairs of them
    std::size_t numbers = 0;  // of pairs with numbers, without what depths of meshes keep; results
    std::size_t total() const { return bodies + pairs + mesh_pairs + numbers; }
  };
  // Heap held, without the shapes.
  Memory memory() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_SCENE_SCENE_H_
