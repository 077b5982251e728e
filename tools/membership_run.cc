// SPDX-License-Identifier: MIT
#include "touchstone/tools/membership_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/exact/mesh_membership.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/shapes/shapes.h"
#include "touchstone/tools/suites/random.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kPlacementsOfAPair = 48;
constexpr std::uint64_t kPlacementsOfALine = 4;
constexpr std::size_t kSamples = 5;
constexpr std::array<int, 3> kFaceCounts = {24, 50, 100};

// Shapes by name and count, each built once.
class Bodies {
 public:
  const TriangleMesh& Get(const std::string& name, int face_count, double scale) {
    std::unique_ptr<TriangleMesh>& mesh = meshes_[{name, face_count, scale}];
    if (mesh == nullptr) {
      mesh = std::make_unique<TriangleMesh>(
          MustBuild(Moved(NamedShape(name, face_count), scale, Vector3d::Zero())));
    }
    return *mesh;
  }

 private:
  std::map<std::tuple<std::string, int, double>, std::unique_ptr<TriangleMesh>> meshes_;
};

// One pair, placed; and placements of it.
class PlacedBodies {
 public:
  PlacedBodies(Bodies* bodies, std::uint64_t seed, std::uint64_t group)
      : random_("membership", seed, group), group_(group) {
    const TriangleMesh& a = Pick(bodies);
    const TriangleMesh& b = Pick(bodies);
    placement_ = static_cast<MembershipPlacement>(group % kMembershipPlacementCount);
    const Eigen::Matrix3d rotation = placement_ == MembershipPlacement::kOnGrid || random_.OneIn(4)
                                         ? random_.AxisRotation()
                                         : random_.Rotation();
    const RelativePose pose = *RelativePose::Make(rotation, Vector3d::Zero());
    pair_ = std::make_unique<MeshPair>(a, b, pose);
    exact_ = std::make_unique<exact::PlacedMeshPair>(a, b, pose);
    Vector3d low_b = rotation * b.vertex(0), high_b = low_b;
    low_ = high_ = a.vertex(0);
    for (const Vector3d& x : a.vertices()) low_ = low_.cwiseMin(x), high_ = high_.cwiseMax(x);
    for (const Vector3d& x : b.vertices()) {
      low_b = low_b.cwiseMin(rotation * x);
      high_b = high_b.cwiseMax(rotation * x);
    }
    low_ -= high_b;
    high_ -= low_b;
  }

  MembershipPlacement placement() const { return placement_; }

  // The translation of placement k, to be asked in order.
  Vector3d Next() {
    switch (placement_) {
      case MembershipPlacement::kAnywhere:
        return RandomPoint();
      case MembershipPlacement::kOnGrid:
        return OnGrid();
      case MembershipPlacement::kNear:
        return Near();
    }
    return Vector3d::Zero();
  }

  void Ask(const Vector3d& x, MembershipStats* stats) {
    const Verdict truth = exact::MeshMembership(*exact_, exact::ExactTranslation(x));
    const Verdict certain = Membership(*pair_, x, {}, &cache_).verdict;
    const Verdict in_doubles = Membership(*pair_, x, {Certainty::kFloat}, &cache_).verdict;
    ++stats->placements;
    ++stats->verdicts[static_cast<int>(truth)];
    stats->undecided += in_doubles == Verdict::kUndecided;
    const bool is_wrong = certain != truth;
    const bool is_wrong_in_doubles = in_doubles != Verdict::kUndecided && in_doubles != truth;
    stats->wrong += is_wrong;
    stats->wrong_in_doubles += is_wrong_in_doubles;
    if ((is_wrong || is_wrong_in_doubles) && stats->samples.size() < kSamples) {
      stats->samples.push_back("pair " + std::to_string(group_) + " at " + HexDouble(x[0]) + ' ' +
                               HexDouble(x[1]) + ' ' + HexDouble(x[2]) + ": " +
                               std::string(ToString(truth)) + ", not " +
                               std::string(ToString(is_wrong ? certain : in_doubles)));
    }
  }

 private:
  const TriangleMesh& Pick(Bodies* bodies) {
    const std::string& name = random_.Pick(ShapeNames());
    const int face_count = random_.Pick(kFaceCounts);
    return bodies->Get(name, face_count, random_.OneIn(3) ? 0.5 : 1.0);
  }

  Vector3d RandomPoint() {
    Vector3d x;
    for (int i = 0; i < 3; ++i) x[i] = random_.Uniform(low_[i], high_[i]);
    return x;
  }

  Vector3d OnGrid() {
    const TriangleMesh &a = pair_->a().mesh, &b = pair_->b().mesh;
    Vector3d x =
        a.vertex(static_cast<int>(random_.Below(a.vertex_count()))) -
        pair_->pose().rotation() * b.vertex(static_cast<int>(random_.Below(b.vertex_count())));
    if (random_.OneIn(2)) {
      for (int i = 0; i < 3; ++i) x[i] += 0.25 * random_.Integer(-4, 4);
    }
    return x;
  }

  // Near the end of M° on a line, several times on the same one.
  Vector3d Near() {
    if (near_left_ == 0) {
      FindContact();
      near_left_ = kPlacementsOfALine;
    }
    --near_left_;
    const double size = (high_ - low_).maxCoeff();
    const double travel = size * std::ldexp(1.0, -random_.Integer(10, 53));
    const Vector3d x = random_.OneIn(2) ? inside_ : outside_;
    return random_.OneIn(3) ? x : Vector3d(x + travel * random_.SpherePoint());
  }

  // Two points a rounding apart, the first in M° and the second not, by halving a line.
  void FindContact() {
    inside_ = RandomPoint(), outside_ = RandomPoint();
    for (int k = 0; k < 20 && !Overlaps(inside_); ++k) inside_ = RandomPoint();
    for (int k = 0; k < 20 && Overlaps(outside_); ++k) outside_ = RandomPoint();
    for (int k = 0; k < 60; ++k) {
      const Vector3d middle = 0.5 * (inside_ + outside_);
      if (middle == inside_ || middle == outside_) return;
      (Overlaps(middle) ? inside_ : outside_) = middle;
    }
  }

  bool Overlaps(const Vector3d& x) {
    return Membership(*pair_, x, {}, &cache_).verdict == Verdict::kOverlap;
  }

  Random random_;
  const std::uint64_t group_;
  MembershipPlacement placement_;
  std::unique_ptr<MeshPair> pair_;
  std::unique_ptr<exact::PlacedMeshPair> exact_;
  MembershipCache cache_;
  Vector3d low_, high_;
  Vector3d inside_, outside_;    // where contact begins or ends
  std::uint64_t near_left_ = 0;  // placements to come there
};

}  // namespace

std::string_view ToString(MembershipPlacement placement) {
  switch (placement) {
    case MembershipPlacement::kAnywhere:
      return "anywhere";
    case MembershipPlacement::kOnGrid:
      return "on the grid";
    case MembershipPlacement::kNear:
      return "near contact";
  }
  return "?";
}

std::array<MembershipStats, kMembershipPlacementCount> RunMembershipPlacements(
    const MembershipRunOptions& options,
    const std::function<void(const MembershipProgress&)>& report) {
  std::array<MembershipStats, kMembershipPlacementCount> stats;
  Bodies bodies;
  const std::uint64_t end = options.first + options.count;
  for (std::uint64_t group = options.first / kPlacementsOfAPair; group * kPlacementsOfAPair < end;
       ++group) {
    PlacedBodies placed(&bodies, options.seed, group);
    MembershipStats& own = stats[static_cast<int>(placed.placement())];
    for (std::uint64_t k = 0; k < kPlacementsOfAPair; ++k) {
      const Vector3d x = placed.Next();
      const std::uint64_t index = group * kPlacementsOfAPair + k;
      if (index >= options.first && index < end) placed.Ask(x, &own);
    }
    if (!report) continue;
    MembershipProgress progress{0, options.count, 0};
    for (const MembershipStats& each : stats) {
      progress.placements += each.placements;
      progress.wrong += each.wrong + each.wrong_in_doubles;
    }
    report(progress);
  }
  return stats;
}

}  // namespace touchstone
