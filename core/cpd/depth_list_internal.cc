// SPDX-License-Identifier: MIT
//
// Lists of features in the way, along slow motions: made once, with room for the motion to go on,
// and only looked through afterwards. The next one is made in parts before it is needed.
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "touchstone/core/cpd/contact_signs_internal.h"
#include "touchstone/core/cpd/depth_searcher_internal.h"

namespace touchstone::internal {
namespace {

constexpr int kListFrames = 6;       // steps of a motion that a list has room for, either way
constexpr int kLeadFrames = 3;       // in which the next one is made
constexpr double kListAngle = 0.06;  // beyond, lists would hold too much

// Where a motion that goes on as it did from one pose to the next will be after so many steps more;
// nothing if that is no pose.
std::optional<RelativePose> PoseAhead(const RelativePose& from, const RelativePose& to, int steps) {
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond(to.rotation() * from.rotation().transpose()).normalized().matrix();
  const Eigen::Vector3d shift = to.translation() - turn * from.translation();
  Eigen::Matrix3d rotation = to.rotation();
  Eigen::Vector3d translation = to.translation();
  for (int i = 0; i < steps; ++i) {
    rotation = turn * rotation;
    translation = turn * translation + shift;
  }
  const auto pose = RelativePose::Make(rotation, translation);
  return pose.ok() ? std::optional(*pose) : std::nullopt;
}

}  // namespace

bool DepthSearcher::UseList() {
  FeatureList& list = s_.list;
  if (!IsListFor(pair_.pose(), list)) {
    if (IsListFor(pair_.pose(), s_.next_list)) {
      std::swap(list, s_.next_list);
      s_.next_list.a.reset();
    } else {
      if (!answer_.was_warm || !s_.pose) return false;
      const MotionBound step = MotionOfB(pair_, *s_.pose);
      if (!(kListFrames * step.angle < kListAngle)) return false;
      BeginList(pair_.pose(), step, &list);
    }
    CollectItems(std::numeric_limits<int>::max(), &list);
    MeasureItems(&list);
  }
  AddItems();
  return used_list_ = true;
}

bool DepthSearcher::IsListOfPair(const FeatureList& list) const {
  return list.a && list.b && list.a->IsSameAs(a_) && list.b->IsSameAs(b_) &&
         list.scale == pair_.scale();
}

bool DepthSearcher::IsListFor(const RelativePose& pose, const FeatureList& list) const {
  if (!IsListOfPair(list) || !(answer_.upper <= list.limit)) return false;
  const MotionBound motion = MotionOfB(pair_, list.middle, pose);
  return motion.distance <= list.distance && motion.angle <= list.angle;
}

void DepthSearcher::BeginList(const RelativePose& middle, const MotionBound& step,
                              FeatureList* list) const {
  list->a = a_;
  list->b = b_;
  list->middle = middle;
  list->scale = pair_.scale();
  list->distance = kListFrames * step.distance + 0x1p-40;
  list->angle = kListFrames * step.angle + 0x1p-40;
  list->limit = 1.02 * answer_.upper + list->distance;
  list->node_pairs = 0;
  list->items.clear();
  list->open.clear();
  for (const SumKind kind : kSumKinds) list->open.push_back({0.0, kind, 0, 0});
}

void DepthSearcher::CollectItems(int most_pairs, FeatureList* list) {
  if (list->open.empty()) return;
  PlaceTrees(list->middle, list->distance, list->angle);
  listed_ = list;
  listed_motion_ = MotionOfB(pair_, list->middle).distance + list->distance;
  radius_ = list->limit;
  std::swap(s_.stack, list->open);
  for (int i = 0; i < most_pairs && !s_.stack.empty(); ++i, ++list->node_pairs) {
    const NodePair pair = s_.stack.back();
    s_.stack.pop_back();
    if (!TreeA(pair.kind).empty() && !TreeB(pair.kind).empty()) Expand(pair);
  }
  std::swap(s_.stack, list->open);
  listed_ = nullptr;
}

void DepthSearcher::MeasureItems(FeatureList* list) const {
  constexpr SumFacetKind kKinds[] = {SumFacetKind::kFaceVertex, SumFacetKind::kVertexFace,
                                     SumFacetKind::kEdgeEdge};
  // From here to any pose in the list's room.
  const MotionBound here = MotionOfB(pair_, list->middle);
  const double distance = here.distance + list->distance, angle = here.angle + list->angle;
  std::size_t kept = 0;
  for (NodePair item : list->items) {
    if (item.kind == SumKind::kVertexVertex) {
      item.near = EstimateVertex(pair_, {item.a, item.b}).norm() - 0x1p-44;
    } else {
      const SumFacet facet = {kKinds[static_cast<int>(item.kind)], false, item.a, item.b};
      if (!MaySupportEitherWay(pair_, a_, b_, facet, angle)) continue;
      item.near = DistanceToFacet(pair_, facet);
    }
    if (item.near - distance < list->limit) list->items[kept++] = item;
  }
  list->items.resize(kept);
  list->measured_at = pair_.pose();
  std::sort(list->items.begin(), list->items.end(),
            [](const NodePair& x, const NodePair& y) { return x.near < y.near; });
}

void DepthSearcher::AddItems() {
  radius_ = answer_.upper;
  const double motion = MotionOfB(pair_, s_.list.measured_at).distance;
  for (const NodePair& item : s_.list.items) {
    if (item.near - motion >= answer_.upper) break;
    AddItem(item.kind, item.a, item.b);
  }
}

void DepthSearcher::PrepareNextList() {
  if (!used_list_ || !s_.pose) return;
  FeatureList& next = s_.next_list;
  if (!IsListOfPair(next) || next.open.empty()) {
    const auto soon = PoseAhead(*s_.pose, pair_.pose(), kLeadFrames + 1);
    if (!soon || IsListFor(*soon, s_.list) || IsListFor(*soon, next)) return;
    const auto middle = PoseAhead(*s_.pose, pair_.pose(), kLeadFrames + kListFrames - 1);
    const MotionBound step = MotionOfB(pair_, *s_.pose);
    if (!middle || !(kListFrames * step.angle < kListAngle)) return;
    BeginList(*middle, step, &next);
  }
  CollectItems(16 + s_.list.node_pairs * 5 / (4 * kLeadFrames), &next);
}

}  // namespace touchstone::internal
