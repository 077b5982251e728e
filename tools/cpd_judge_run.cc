// SPDX-License-Identifier: MIT
#include "touchstone/tools/cpd_judge_run.h"

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "touchstone/core/cpd/continuous_penetration_depth.h"
#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/tools/cpd_run.h"
#include "touchstone/tools/shapes/paper_scenes.h"
#include "touchstone/tools/shapes/shapes.h"
#include "touchstone/tools/suites/random.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::uint64_t kPlacementsOfAPair = 12;
constexpr std::size_t kSamples = 5;
constexpr std::array<int, 3> kFaceCounts = {50, 100, 200};
constexpr const char* kOtherNormals[] = {"area", "uniform", "interpolated"};

ContinuousDepthOptions OptionsOf(CpdCase which, std::uint64_t group) {
  ContinuousDepthOptions options;
  switch (which) {
    case CpdCase::kNearest:
      options.track_branch = false;
      break;
    case CpdCase::kOtherNormals:
      return *NormalsFromWord(kOtherNormals[group / kCpdCaseCount % 3]);
    case CpdCase::kMeanNormals:
    case CpdCase::kSceneMean:
      return *NormalsFromWord("mean");
    case CpdCase::kMoving:
    case CpdCase::kScene:
      break;
  }
  return options;
}

// A pair and its placements, to be asked in order.
class CpdPlacements {
 public:
  CpdPlacements(std::uint64_t seed, std::uint64_t group)
      : which_(static_cast<CpdCase>(group % kCpdCaseCount)),
        options_(OptionsOf(which_, group)),
        random_("cpd", seed, group),
        is_scene_(which_ == CpdCase::kScene || which_ == CpdCase::kSceneMean) {
    const auto scenes = AllPaperScenes();
    if (is_scene_) {
      scene_ = &scenes[group / kCpdCaseCount % scenes.size()];
      name_ = scene_->name;
      at_ = random_.Unit();
    } else {
      const std::string a = random_.Pick(ShapeNames()), b = random_.Pick(ShapeNames());
      name_ = a + " and " + b;
      shape_a_ = NamedShape(a, random_.Pick(kFaceCounts));
      shape_b_ = NamedShape(b, random_.Pick(kFaceCounts));
    }
    a_.emplace(MustBuild(is_scene_ ? scene_->a : shape_a_));
    b_.emplace(MustBuild(is_scene_ ? scene_->b : shape_b_));
    body_a_.emplace(*a_);
    body_b_.emplace(*b_);
    solver_.emplace(*a_, *b_, options_);
    step_ = std::ldexp(0.01, -random_.Integer(0, 6));
    axis_ = random_.SpherePoint();
    if (!is_scene_) PlaceAnew();
  }

  CpdCase which() const { return which_; }

  void Next() {
    if (is_scene_) {
      at_ += 0.2 * step_;
    } else if (which_ == CpdCase::kNearest) {
      solver_->Forget();
      PlaceAnew();
    } else {
      rotation_ = Eigen::AngleAxisd(step_, axis_).toRotationMatrix() * rotation_;
      translation_ += step_ * random_.SpherePoint();
    }
  }

  // Every placement is answered, for the solver follows them; those in the range are judged.
  void Ask(bool is_in_range, CpdJudgeStats* stats) {
    const auto pose =
        is_scene_ ? std::optional(scene_->PoseAt(at_)) : Made(rotation_, translation_);
    if (!pose) return;
    const ContinuousDepthResult result = solver_->Update(*pose);
    if (!is_in_range) return;
    ++stats->placements;
    stats->overlapping += result.status != ContinuousDepthStatus::kSeparate;
    if (result.status != ContinuousDepthStatus::kFound) return;
    ++stats->found;
    stats->kept += result.iterations == 0;
    const MeshDepthResult depth =
        MeshPenetrationDepth(MeshPair(*a_, *b_, *pose), *body_a_, *body_b_);
    const auto findings =
        JudgedPhong(*a_, *b_, *pose, *solver_, options_, result, depth.lower_bound);
    stats->wrong += !findings.empty();
    if (!findings.empty() && stats->samples.size() < kSamples) {
      stats->samples.push_back(name_ + ": " + findings.front());
    }
  }

 private:
  static std::optional<RelativePose> Made(const Matrix3d& rotation, const Vector3d& translation) {
    const auto pose = RelativePose::Make(rotation, translation);
    if (!pose.ok()) return std::nullopt;
    return *pose;
  }

  // Turned anyhow, between two sums of vertices; overlapping, if one of a few is.
  void PlaceAnew() {
    rotation_ = random_.Rotation();
    const auto sum = [&] {
      const auto vertex = [&](const TriangleMesh& mesh) {
        return mesh.vertex(static_cast<int>(random_.Below(mesh.vertex_count())));
      };
      const Vector3d p = vertex(*a_);
      return Vector3d(p - rotation_ * vertex(*b_));
    };
    for (int k = 0; k < 30; ++k) {
      const Vector3d x = sum();
      translation_ = x + random_.Unit() * (sum() - x);
      const auto pose = Made(rotation_, translation_);
      if (pose && Membership(MeshPair(*a_, *b_, *pose), Vector3d(Vector3d::Zero())).verdict ==
                      Verdict::kOverlap) {
        return;
      }
    }
  }

  const CpdCase which_;
  const ContinuousDepthOptions options_;
  Random random_;
  const bool is_scene_;
  const PaperScene* scene_ = nullptr;
  std::string name_;
  Shape shape_a_, shape_b_;
  std::optional<TriangleMesh> a_, b_;
  std::optional<ContactBody> body_a_, body_b_;
  std::optional<ContinuousPenetrationDepth> solver_;
  double at_ = 0.0, step_ = 0.0;
  Vector3d axis_, translation_ = Vector3d::Zero();
  Matrix3d rotation_ = Matrix3d::Identity();
};

}  // namespace

std::string_view ToString(CpdCase which) {
  constexpr std::string_view kNames[] = {"nearest",      "moving", "other normals",
                                         "mean normals", "scenes", "scenes, mean normals"};
  return kNames[static_cast<int>(which)];
}

std::array<CpdJudgeStats, kCpdCaseCount> RunCpdJudge(const CpdJudgeOptions& options,
                                                     const std::function<void(double)>& report) {
  std::array<CpdJudgeStats, kCpdCaseCount> stats;
  const std::uint64_t end = options.first + options.count;
  for (std::uint64_t group = options.first / kPlacementsOfAPair; group * kPlacementsOfAPair < end;
       ++group) {
    CpdPlacements placements(options.seed, group);
    for (std::uint64_t k = 0; k < kPlacementsOfAPair; ++k) {
      const std::uint64_t index = group * kPlacementsOfAPair + k;
      if (index >= end) break;
      if (k > 0) placements.Next();
      placements.Ask(index >= options.first, &stats[static_cast<int>(placements.which())]);
      if (report && index >= options.first) {
        report(static_cast<double>(index + 1 - options.first) / static_cast<double>(options.count));
      }
    }
  }
  return stats;
}

}  // namespace touchstone
