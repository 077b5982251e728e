// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/mesh_penetration_depth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "touchstone/core/cpd/contact_name_internal.h"
#include "touchstone/core/cpd/depth_search_internal.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/mesh/nearest_on_triangle.h"
#include "touchstone/core/minkowski/local_sum.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using internal::ContactName;
using internal::ContactWall;
using internal::DepthAnswer;

constexpr double kRoundUp = 1.0 + 0x1p-50, kRoundDown = 1.0 - 0x1p-50;

NearestKind KindOf(const ContactName& name) {
  if (name.is_vertex) return NearestKind::kNaturalVertex;
  if (name.wall_count == 0) return NearestKind::kPlaneFoot;
  if (name.wall_count == 2) return NearestKind::kTriplePoint;
  return name.walls[0].is_edge ? NearestKind::kReflexEdgeFoot : NearestKind::kCrossingFoot;
}

// direction = sum of weights * normals, for as many columns; in the least squares' sense where they
// do not span it.
Vector3d WeightsOf(const Matrix3d& normals, int count, const Vector3d& direction) {
  const Vector3d p = normals.col(0), q = normals.col(1), r = normals.col(2);
  if (count == 1) return {p.dot(direction), 0.0, 0.0};
  if (count == 2) {
    const double x = p.dot(direction), y = q.dot(direction), cosine = p.dot(q);
    const double rest = 1.0 - cosine * cosine;
    if (!(rest > 1e-16)) return {x, 0.0, 0.0};
    return {(x - y * cosine) / rest, (y - x * cosine) / rest, 0.0};
  }
  const double determinant = p.dot(q.cross(r));
  if (!(std::abs(determinant) > 1e-16)) return {p.dot(direction), 0.0, 0.0};
  return Vector3d(direction.dot(q.cross(r)), direction.dot(r.cross(p)), direction.dot(p.cross(q))) /
         determinant;
}

// The contacts of an answer, in the pair's scaled frame until they are handed out.
class Contacts {
 public:
  Contacts(const MeshPair& pair, const ContactName& name, const Vector3d& translation)
      : pair_(pair), name_(name), q_(pair.scale() * translation) {}

  void Find(MeshDepthResult* result) const {
    const Vector3d direction = q_.stableNormalized();
    result->contact_count = 0;
    const auto add = [&](const SumFacet& features, const Vector3d& normal, double weight,
                         const Vector3d& on_a) {
      result->contacts[result->contact_count++] = {features, normal, on_a / pair_.scale(),
                                                   (on_a - q_) / pair_.scale(), weight};
    };
    if (name_.is_vertex) {
      add({SumFacetKind::kFaceVertex, false, -1, -1}, direction, 1.0, OfVertex(name_.vertex));
      return;
    }
    const ContactWall* edge = nullptr;
    SumFacet facets[3] = {name_.facet};
    int count = 1;
    for (int k = 0; k < name_.wall_count; ++k) {
      if (name_.walls[k].is_edge) {
        edge = &name_.walls[k];
      } else {
        facets[count++] = name_.walls[k].facet;
      }
    }
    if (edge != nullptr) {
      AddAtEdge(*edge, facets, count, direction, add);
      return;
    }
    Matrix3d normals = Matrix3d::Zero();
    for (int k = 0; k < count; ++k) {
      normals.col(k) = internal::EstimatePlane(pair_, facets[k]).normal;
    }
    const Vector3d weights = WeightsOf(normals, count, direction);
    for (int k = 0; k < count; ++k) {
      add(facets[k], normals.col(k), std::max(0.0, weights[k]), OfFacet(facets[k]));
    }
  }

 private:
  // The facet's own contact pushes across its edge; another one may push along it.
  template <class Add>
  void AddAtEdge(const ContactWall& edge, const SumFacet* facets, int count,
                 const Vector3d& direction, const Add& add) const {
    const bool is_edge_of_b = edge.from.a == edge.to.a;
    const Vector3d on_a =
        is_edge_of_b ? pair_.a().points[edge.from.a] : Vector3d(pair_.b().points[edge.from.b] + q_);
    double weight = 0.0;
    Vector3d normal = Vector3d::Zero();
    if (count > 1) {
      const Vector3d along =
          internal::EstimateVertex(pair_, edge.to) - internal::EstimateVertex(pair_, edge.from);
      normal = internal::EstimatePlane(pair_, facets[1]).normal;
      const double rate = normal.dot(along);
      if (rate != 0.0) weight = std::max(0.0, direction.dot(along) / rate);
    }
    const Vector3d rest = direction - weight * normal;
    add(facets[0], rest.stableNormalized(), rest.norm(), on_a);
    if (count > 1) add(facets[1], normal, weight, OfFacet(facets[1]));
  }

  Vector3d OfVertex(const SumVertex& v) const { return pair_.a().points[v.a]; }

  Vector3d OfFacet(const SumFacet& facet) const {
    return internal::ContactPointOnA(pair_, facet, q_);
  }

  const MeshPair& pair_;
  const ContactName& name_;
  const Vector3d q_;
};

// The answer's own point instead of one a step off it, if it is not in M°.
void ConfirmExactly(const MeshPair& pair, DepthAnswer* answer, MembershipCache* cache,
                    MeshDepthResult* result) {
  const auto exact = internal::ExactPointOf(pair, *answer->name);
  if (!exact) return;
  const auto [x, error] = internal::Rounded(*exact);
  ++result->exact_memberships;
  const Verdict verdict =
      Membership(pair, Translation(x, error, *exact), {Certainty::kExact}, cache).verdict;
  const Vector3d scaled = pair.scale() * x;
  if (verdict == Verdict::kOverlap || !(scaled.norm() <= answer->upper)) return;
  answer->at = scaled;
  answer->at_error = 2.0 * error * pair.scale();
  answer->is_exact = true;
}

// The nearest point of ∂M within the upper bound, by the exact arrangement of the facets there.
void DecideByBoundary(const MeshPair& pair, MeshDepthResult* result) {
  LocalMinkowskiSum local(pair.a().mesh, pair.b().mesh);
  const LocalSum& sum =
      local.Update(pair.pose(), {Vector3d::Zero(), result->upper_bound * kRoundUp});
  if (!sum.status.ok()) return;
  Vector3d nearest = result->translation;
  SumFacet facet{SumFacetKind::kFaceVertex, false, -1, -1};
  const auto nearest_on = [&at = sum.vertices](int a, int b, int c) {
    return NearestOnTriangle(Vector3d::Zero(), at[a], at[b], at[c]);
  };
  const auto take = [&](const Vector3d& x, int number) {
    if (!(x.squaredNorm() < nearest.squaredNorm())) return;
    nearest = x;
    facet = number >= 0 ? sum.facets[number] : SumFacet{SumFacetKind::kFaceVertex, false, -1, -1};
  };
  for (std::size_t t = 0; t < sum.triangles.size(); ++t) {
    const auto& [a, b, c] = sum.triangles[t];
    take(nearest_on(a, b, c), sum.facet_of_triangle[t]);
  }
  for (std::size_t t = 0; t < sum.sheets.size(); ++t) {
    const auto& [a, b, c] = sum.sheets[t];
    take(nearest_on(a, b, c), sum.facet_of_sheet[t]);
  }
  for (const auto& [a, b] : sum.segments) take(nearest_on(a, b, b), -1);
  for (const int p : sum.points) take(sum.vertices[p], -1);
  // Corners are off by `rounding` in each coordinate, the foot by as much again.
  const double distance = nearest.norm();
  const double error = 4.0 * sum.rounding + 0x1p-48 * (distance + 1.0 / pair.scale());
  result->by_boundary = true;
  result->status = MeshDepthStatus::kCertain;
  result->lower_bound = std::max(result->lower_bound, distance - error);
  if (distance < result->translation.norm()) {
    result->translation = nearest;
    result->upper_bound = distance + error;
    result->kind = NearestKind::kBoundary;
  }
  result->lower_bound = std::min(result->lower_bound, result->upper_bound);
}

}  // namespace

std::string_view ToString(MeshDepthStatus status) {
  constexpr std::string_view kNames[] = {"separate", "certain", "open", "limit"};
  return kNames[static_cast<int>(status)];
}

std::string_view ToString(NearestKind kind) {
  constexpr std::string_view kNames[] = {"none",        "plane-foot",   "crossing-foot",
                                         "reflex-edge", "triple-point", "natural-vertex",
                                         "boxes",       "boundary"};
  return kNames[static_cast<int>(kind)];
}

MeshDepthCache::MeshDepthCache() : scratch_(std::make_unique<internal::DepthScratch>()) {}
MeshDepthCache::~MeshDepthCache() = default;
MeshDepthCache::MeshDepthCache(MeshDepthCache&&) noexcept = default;
MeshDepthCache& MeshDepthCache::operator=(MeshDepthCache&&) noexcept = default;

void MeshDepthCache::Clear() {
  scratch_->answer.reset();
  scratch_->pose.reset();
  for (internal::FeatureList* list : {&scratch_->list, &scratch_->next_list}) {
    list->a.reset();
    list->b.reset();
  }
  scratch_->prism_names.clear();
  scratch_->ball_faces.clear();
  scratch_->membership.crossing = {};
}

MeshDepthResult MeshPenetrationDepth(const MeshPair& pair, const ContactBody& a,
                                     const ContactBody& b, const MeshDepthOptions& options,
                                     MeshDepthCache* cache) {
  std::optional<MeshDepthCache> own;
  internal::DepthScratch& scratch = (cache != nullptr ? *cache : own.emplace()).scratch();
  MeshDepthResult result;
  DepthAnswer answer = internal::SearchDepth(pair, a, b, options, &scratch, &result);
  result.status = answer.status;
  result.was_warm = answer.was_warm;
  if (answer.status == MeshDepthStatus::kSeparate) return result;

  if (options.confirm_exactly && answer.name && !answer.is_exact &&
      answer.status == MeshDepthStatus::kCertain) {
    ConfirmExactly(pair, &answer, &scratch.membership, &result);
  }
  const double scale = pair.scale();
  result.translation = answer.at / scale;
  result.upper_bound = (answer.at.norm() * kRoundUp + 2.0 * answer.at_error) / scale;
  result.lower_bound = std::min(answer.lower / scale, result.upper_bound);
  if (answer.is_exact && answer.status == MeshDepthStatus::kCertain) {
    // The point's own distance, a few roundings either way.
    result.lower_bound =
        std::max(0.0, (answer.at.norm() * kRoundDown - 2.0 * answer.at_error) / scale);
  }
  result.is_exact = answer.is_exact;
  if (answer.status == MeshDepthStatus::kOpen && options.certainty == Certainty::kExact) {
    result.kind = answer.name ? KindOf(*answer.name) : NearestKind::kBoxes;
    DecideByBoundary(pair, &result);
    if (result.kind == NearestKind::kBoundary) return result;
  }
  result.kind = answer.name ? KindOf(*answer.name) : NearestKind::kBoxes;
  if (!answer.name || !(answer.at.norm() > 0.0)) return result;
  Contacts(pair, *answer.name, result.translation).Find(&result);
  result.rate_of_translation = -answer.at.stableNormalized();
  Vector3d torque = Vector3d::Zero();
  for (int k = 0; k < result.contact_count; ++k) {
    const DepthContact& contact = result.contacts[k];
    torque -=
        contact.weight * (contact.point_on_b - pair.pose().translation()).cross(contact.normal);
  }
  result.rate_of_rotation = torque;
  return result;
}

}  // namespace touchstone
