// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_SCENE_SCENE_DATA_INTERNAL_H_
#define TOUCHSTONE_CORE_SCENE_SCENE_DATA_INTERNAL_H_

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "touchstone/core/scene/broad_phase_internal.h"
#include "touchstone/core/scene/contacts_internal.h"
#include "touchstone/core/scene/mesh_pair_internal.h"
#include "touchstone/core/scene/numbers_internal.h"
#include "touchstone/core/scene/scene.h"

namespace touchstone {

namespace internal {

inline constexpr int kNoPart = -1;

// A slot for a body. One that was removed is kept as it was until the next step has told of it.
struct SceneBody {
  enum class Life : std::uint8_t { kFree, kAlive, kRemoved };

  std::uint32_t generation = 0;
  Life life = Life::kFree;
  bool moved = false;      // listed in Data::moved
  bool has_pairs = false;  // takes part in a pair subscription or is ignored by another body
  int first_part = kNoPart;
  WorldPose pose;
  Filter filter;
  Subscriptions subscriptions;
  std::optional<SceneShape> shape;
};

// What is read of a part when a pair of it is decided.
struct PartData {
  const ScenePart* part = nullptr;
  Eigen::Vector3d turned_middle = Eigen::Vector3d::Zero();
  std::int32_t body = -1;
  std::int32_t index = 0;       // in the shape
  std::int32_t next = kNoPart;  // of the body, or of the free ones
  double step_motion = 0.0;     // since the last step
};

// A pool whose places stay as long as they are in use.
template <class T>
class Pool {
 public:
  int Take() {
    if (free_.empty()) {
      items_.push_back(std::make_unique<T>());
      return static_cast<int>(items_.size()) - 1;
    }
    const int place = free_.back();
    free_.pop_back();
    return place;
  }
  void Return(int place) { free_.push_back(place); }
  T& operator[](int place) { return *items_[place]; }
  const T& operator[](int place) const { return *items_[place]; }
  int size() const { return static_cast<int>(items_.size()); }

 private:
  std::vector<std::unique_ptr<T>> items_;
  std::vector<int> free_;
};

}  // namespace internal

// The steps of Step(), in order, are in scene.cc (bodies and pairs), looks.cc (verdicts) and
// numbers.cc.
struct Scene::Data {
  using Slots = std::pair<std::uint32_t, std::uint32_t>;

  explicit Data(const SceneOptions& chosen);

  // scene.cc
  internal::SceneBody* Find(BodyHandle handle);
  BodyHandle HandleOf(std::uint32_t slot) const { return {slot, bodies[slot].generation}; }
  template <class Visit>
  void ForParts(const internal::SceneBody& body, Visit visit) {
    for (int part = body.first_part; part != internal::kNoPart; part = parts[part].next) {
      visit(part);
    }
  }
  internal::PlacedPart Placed(int part) const {
    const internal::PartData& data = parts[part];
    return {data.part, &bodies[data.body].pose, data.turned_middle};
  }
  void MarkMoved(std::uint32_t slot);
  int TakePart();
  void Settle();
  // Its box and its pairs, in the next step, though it has not moved.
  void LookAgain(const internal::SceneBody& body);
  // What is wanted of two bodies together; nothing where they pass through each other.
  bool MayMeet(std::uint32_t slot_a, std::uint32_t slot_b) const;
  bool WantsVerdict(const internal::SceneBody& a, const internal::SceneBody& b,
                    const Subscriptions* pair) const;
  const Subscriptions* PairSubscriptions(std::uint32_t slot_a, std::uint32_t slot_b) const;

  // broad.cc
  void UpdateBoxes(SceneCounters* counters);
  void MakeBox(int part);
  void ForgetRemoved();
  void Rewire();  // after changes of filters and subscriptions
  void AddPairs(SceneCounters* counters);
  int AddPair(int part_a, int part_b, bool is_pinned);
  void Wire(int pair);
  void RemovePair(int pair);
  void ReturnNumbers(internal::PairState* state);

  // looks.cc
  void Look(SceneCounters* counters);
  void FindActive(SceneCounters* counters);
  bool IsDue(int pair) const;
  void MakeMeshStates();
  void LookAt(int k, SceneCounters* counters);
  void Fetch(std::size_t k, std::size_t end) const;
  void TellChanges();

  // numbers.cc
  void FindNumbers(SceneCounters* counters);
  void FindNumbersOf(internal::PairNumbers* wanted, SceneCounters* counters);
  void FindConvexNumbersOf(Verdict verdict, internal::PairNumbers* wanted,
                           SceneCounters* counters) const;
  void FindMeshNumbersOf(internal::MeshPairState* meshes, Verdict verdict,
                         internal::PairNumbers* wanted, SceneCounters* counters) const;
  bool KeepsItsDistance(const internal::PairNumbers& wanted, SceneCounters* counters) const;
  void LimitDistance(double beyond, internal::PairNumbers* wanted) const;
  void ListNumbers();
  void ListNumbersOf(const internal::PairNumbers& numbers_of_pair);

  double TravelOf(int part) const;
  internal::Contact ContactOf(int pair, Verdict verdict) const;

  SceneOptions options;

  std::vector<internal::SceneBody> bodies;
  std::vector<std::uint32_t> free_slots, removed_slots, moved_slots;
  int alive_count = 0;

  // By part. How far its points have moved at most, all steps added up; infinite: start from zero
  // after this step.
  std::vector<double> travel;
  std::vector<double> box_limit;  // travel at which a part may have left its box
  std::vector<std::uint8_t> moved;
  std::vector<Box3> boxes;  // fat
  std::vector<internal::PartData> parts;
  int free_part = internal::kNoPart;
  int part_count = 0;
  bool has_meshes = false;  // or had
  // Pairs of parts of one body, which are no pairs.
  long pairs_within = 0;

  std::unique_ptr<internal::BroadPhaseFinder> broad_phase;
  std::vector<int> boxed;  // parts with new boxes in this step
  std::vector<std::pair<int, int>> near;
  internal::PairTable pairs;
  int first_new_pair = 0;
  bool must_rewire = false;
  std::vector<std::pair<int, int>> pinned;  // to become pairs

  std::map<Slots, Subscriptions> pair_subscriptions;
  std::set<Slots> ignored;

  std::vector<int> active;  // pairs to look at
  std::vector<int> active_counts;
  std::vector<std::uint8_t> must_drop;  // by place in `active`
  internal::Pool<internal::MeshPairState> mesh_states;
  internal::Contacts contacts;

  internal::Pool<internal::PairNumbers> numbers;
  std::vector<int> listed;  // numbers in order
  std::vector<SceneNumber<DistanceResult>> distances;
  std::vector<SceneNumber<SurfaceDistanceResult>> mesh_distances;
  std::vector<SceneNumber<PenetrationResult>> depths;
  std::vector<SceneNumber<MeshDepthResult>> mesh_depths;
  std::vector<SceneNumber<ContinuousDepthResult>> continuous_depths;
  std::vector<SceneNumber<DirectionalResult>> travels;
  std::vector<SceneNumber<SurfaceTravelResult>> mesh_travels;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_SCENE_SCENE_DATA_INTERNAL_H_
