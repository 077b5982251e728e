// SPDX-License-Identifier: MIT
#include "touchstone/tools/mesh_depth_run.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/exact/judge_cpd.h"
#include "touchstone/tools/cpd_run.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/shapes/shapes.h"
#include "touchstone/tools/suites/random.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::uint64_t kPlacementsOfAPair = 16;
constexpr int kUnjudgedSteps = 3;  // of a motion, with Nef polyhedra, before the one judged
constexpr std::size_t kSamples = 5;
constexpr std::array<int, 3> kFaceCounts = {50, 100, 200};
constexpr int kSmallFaceCount = 24;

// What contact queries need of a shape; each made once.
struct Body {
  TriangleMesh mesh;
  ContactBody body;
  explicit Body(const Shape& shape) : mesh(MustBuild(shape)), body(mesh) {}
};

class Bodies {
 public:
  const Body& Get(const std::string& name, int face_count) {
    std::unique_ptr<Body>& body = bodies_[{name, face_count}];
    if (body == nullptr) body = std::make_unique<Body>(NamedShape(name, face_count));
    return *body;
  }

 private:
  std::map<std::pair<std::string, int>, std::unique_ptr<Body>> bodies_;
};

// With Nef polyhedra a group is one placement: every pair of shapes in its turn, and as often again
// placed otherwise.
struct NefGroup {
  std::size_t a = 0, b = 0;  // of ShapeNames
  DepthPlacement placement;

  explicit NefGroup(std::uint64_t group) {
    const std::size_t shapes = ShapeNames().size(), pairs = shapes * (shapes + 1) / 2;
    std::size_t pair = group % pairs;
    while (pair >= shapes - a) pair -= shapes - a++;
    b = a + pair;
    placement = static_cast<DepthPlacement>((group + group / pairs) % 3);
    if (ShapeNames()[a] == "dimpled" && ShapeNames()[b] == "spiked") {
      placement = DepthPlacement::kLocked;
    }
  }
};

// One pair, and placements of it, to be asked in order.
class PlacedBodies {
 public:
  PlacedBodies(Bodies* bodies, const MeshDepthRunOptions& options, std::uint64_t group)
      : options_(options),
        random_("mesh-depth", options.seed, group),
        group_(group),
        placement_(options.nef ? NefGroup(group).placement
                               : static_cast<DepthPlacement>(group % kDepthPlacementCount)),
        a_(Pick(bodies, "dimpled")),
        b_(Pick(bodies, "spiked")) {
    rotation_ = placement_ == DepthPlacement::kOnGrid ? random_.AxisRotation() : random_.Rotation();
    axis_ = random_.SpherePoint();
    step_ = std::ldexp(0.02, -random_.Integer(0, 6));
    if (placement_ == DepthPlacement::kLocked) rotation_ = LockedRotation();
    translation_ = Overlapping();
  }

  DepthPlacement placement() const { return placement_; }

  void Next() {
    switch (placement_) {
      case DepthPlacement::kAnywhere:
        rotation_ = random_.Rotation();
        translation_ = Overlapping();
        break;
      case DepthPlacement::kOnGrid:
        translation_ = Overlapping();
        break;
      case DepthPlacement::kMoving:
        rotation_ = Eigen::AngleAxisd(step_, axis_).toRotationMatrix() * rotation_;
        translation_ += step_ * random_.SpherePoint();
        break;
      case DepthPlacement::kLocked:
        rotation_ = LockedRotation();
        translation_ = Overlapping();
        break;
    }
  }

  // Every placement of a motion is answered, for the cache; those in the range are judged.
  void Ask(bool is_in_range, MeshDepthStats* stats) {
    const bool is_moving = placement_ == DepthPlacement::kMoving;
    if (!is_in_range && !is_moving) return;
    const auto pose = RelativePose::Make(rotation_, translation_);
    if (!pose.ok()) return;
    const MeshPair pair(a_.mesh, b_.mesh, *pose);
    const MeshDepthResult result =
        MeshPenetrationDepth(pair, a_.body, b_.body, {}, is_moving ? &cache_ : nullptr);
    if (!is_in_range) return;
    ++stats->placements;
    stats->overlapping += result.status != MeshDepthStatus::kSeparate;
    stats->certain += result.status == MeshDepthStatus::kCertain;
    stats->by_boundary += result.by_boundary;
    stats->natural_vertices += result.kind == NearestKind::kNaturalVertex;
    const auto findings = options_.nef ? JudgedByNef(*pose, result) : Judged(*pose, result);
    if (!findings) {
      ++stats->late;
      if (options_.nef) stats->late_pairs.push_back(a_name_ + " and " + b_name_);
      return;
    }
    ++stats->judged;
    stats->wrong += !findings->empty();
    if (!findings->empty() && stats->samples.size() < kSamples) {
      stats->samples.push_back("pair " + std::to_string(group_) + ", " + a_name_ + " and " +
                               b_name_ + ": " + findings->front());
    }
  }

 private:
  const Body& Pick(Bodies* bodies, const std::string& locked) {
    std::string& name = locked == "dimpled" ? a_name_ : b_name_;
    const bool is_locked = placement_ == DepthPlacement::kLocked;
    if (options_.nef) {
      const NefGroup group(group_);
      name = ShapeNames()[locked == "dimpled" ? group.a : group.b];
      return bodies->Get(name, kSmallFaceCount);
    }
    name = is_locked ? locked : random_.Pick(ShapeNames());
    return bodies->Get(name, random_.Pick(kFaceCounts));
  }

  Matrix3d LockedRotation() {
    const Vector3d tilt = std::ldexp(1.0, -random_.Integer(2, 30)) * random_.SpherePoint();
    const Matrix3d over = Vector3d(1, -1, -1).asDiagonal();
    return Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix() * over *
           Eigen::AngleAxisd(random_.OneIn(2) ? 0.0 : random_.Uniform(0.0, 6.0), Vector3d::UnitZ())
               .toRotationMatrix();
  }

  // A translation at which the interiors meet, if one of a few does.
  Vector3d Overlapping() {
    Vector3d x = Vector3d::Zero();
    for (int k = 0; k < 30; ++k) {
      x = Placed();
      const auto pose = RelativePose::Make(rotation_, x);
      if (!pose.ok()) continue;
      if (Membership(MeshPair(a_.mesh, b_.mesh, *pose), Vector3d(Vector3d::Zero())).verdict ==
          Verdict::kOverlap) {
        break;
      }
    }
    return x;
  }

  Vector3d Placed() {
    const auto vertex = [&](const TriangleMesh& mesh) {
      return mesh.vertex(static_cast<int>(random_.Below(mesh.vertex_count())));
    };
    const Vector3d p = vertex(a_.mesh), q = vertex(b_.mesh);
    Vector3d x = p - rotation_ * q;
    if (placement_ == DepthPlacement::kOnGrid) {
      for (int i = 0; i < 3; ++i) x[i] += 0.25 * random_.Integer(-4, 4);
      return x;
    }
    // Between two sums of vertices, so inside the box of all.
    const Vector3d other = vertex(a_.mesh) - rotation_ * vertex(b_.mesh);
    if (placement_ != DepthPlacement::kLocked || random_.OneIn(2)) {
      return x + random_.Unit() * (other - x);
    }
    return x + std::ldexp(1.0, -random_.Integer(2, 20)) * random_.SpherePoint();
  }

  exact::MeshDepthClaim ClaimOf(const MeshDepthResult& result) const {
    return {result.translation, result.lower_bound, result.upper_bound,
            result.is_exact || result.by_boundary};
  }

  std::optional<std::vector<std::string>> Judged(const RelativePose& pose,
                                                 const MeshDepthResult& result) const {
    return JudgedMeshDepth(a_.mesh, b_.mesh, pose, result, 12);
  }

  // In a child that may use so much of the processor; a byte comes back, or nothing in time.
  std::optional<std::vector<std::string>> JudgedByNef(const RelativePose& pose,
                                                      const MeshDepthResult& result) const {
    if (result.status == MeshDepthStatus::kSeparate) return Judged(pose, result);
    int ends[2];
    if (pipe(ends) != 0) return std::nullopt;
    const pid_t child = fork();
    if (child == 0) {
      const auto seconds = static_cast<rlim_t>(std::ceil(options_.nef_seconds));
      const rlimit limit{seconds, seconds + 1};
      setrlimit(RLIMIT_CPU, &limit);
      const auto findings = exact::JudgeMeshDepthByNef(a_.mesh, b_.mesh, pose, ClaimOf(result));
      const std::string told = findings.empty() ? "+" : "-" + findings.front();
      const bool is_told =
          write(ends[1], told.data(), told.size()) == static_cast<ssize_t>(told.size());
      _exit(is_told ? 0 : 1);
    }
    close(ends[1]);
    char told[512];
    const ssize_t length = child > 0 ? read(ends[0], told, sizeof told) : 0;
    close(ends[0]);
    if (child > 0) waitpid(child, nullptr, 0);
    if (length <= 0) return std::nullopt;
    if (told[0] == '+') return std::vector<std::string>();
    return std::vector<std::string>{std::string(told + 1, told + length)};
  }

  const MeshDepthRunOptions& options_;
  Random random_;
  const std::uint64_t group_;
  const DepthPlacement placement_;
  std::string a_name_, b_name_;
  const Body &a_, &b_;
  Matrix3d rotation_;
  Vector3d translation_, axis_;
  double step_ = 0.0;
  MeshDepthCache cache_;
};

}  // namespace

std::string_view ToString(DepthPlacement placement) {
  constexpr std::string_view kNames[] = {"anywhere", "on the grid", "moving", "locked"};
  return kNames[static_cast<int>(placement)];
}

std::array<MeshDepthStats, kDepthPlacementCount> RunMeshDepths(
    const MeshDepthRunOptions& options, const std::function<void(double)>& report) {
  std::array<MeshDepthStats, kDepthPlacementCount> stats;
  Bodies bodies;
  const std::uint64_t end = options.first + options.count;
  const std::uint64_t of_a_group = options.nef ? 1 : kPlacementsOfAPair;
  for (std::uint64_t group = options.first / of_a_group; group * of_a_group < end; ++group) {
    PlacedBodies placed(&bodies, options, group);
    MeshDepthStats& own = stats[static_cast<int>(placed.placement())];
    if (options.nef && placed.placement() == DepthPlacement::kMoving) {
      for (int k = 0; k < kUnjudgedSteps; ++k) {
        placed.Ask(false, &own);
        placed.Next();
      }
    }
    for (std::uint64_t k = 0; k < of_a_group; ++k) {
      const std::uint64_t index = group * of_a_group + k;
      if (index >= end) break;
      if (k > 0) placed.Next();
      placed.Ask(index >= options.first, &own);
      if (report && index >= options.first) {
        report(static_cast<double>(index + 1 - options.first) / static_cast<double>(options.count));
      }
    }
  }
  return stats;
}

}  // namespace touchstone
