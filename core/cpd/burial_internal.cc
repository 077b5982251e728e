// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/burial_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>

#include "touchstone/core/base/vector_clones.h"
#include "touchstone/core/cpd/contact_name_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// Points of M and of prisms have coordinates below 2, so they are within 7 of each other: a normal
// off by e in each coordinate moves a plane there by at most 7 sqrt(3) e. Points are off by 2^-49,
// heights are rounded by as much.
constexpr double kReach = 12.2;
constexpr double kPointSlack = 0x1p-46;
// A plane less certain than this buries nothing.
constexpr double kWorstSlack = 0x1p-16;

}  // namespace

double Prism::Margin(const Vector3d& x) const {
  double margin = 1e300;
  for (int k = 0; k < kPrismPlanes; ++k) margin = std::min(margin, offsets[k] - normals[k].dot(x));
  return margin;
}

SumFacet FacetOf(const MeshPair& pair, const PrismName& name, int plane) {
  const PlacedMesh& of_edge = name.edge_is_of_a ? pair.a() : pair.b();
  const PlacedMesh& of_face = name.edge_is_of_a ? pair.b() : pair.a();
  if (plane < 2) {
    const int h = of_edge.mesh.half_edge_of(name.edge);
    const int v = plane == 0 ? of_edge.mesh.tail(h) : of_edge.mesh.head(h);
    if (name.edge_is_of_a) return {SumFacetKind::kVertexFace, false, v, name.face};
    return {SumFacetKind::kFaceVertex, false, name.face, v};
  }
  const int side = of_face.mesh.edge_of(3 * name.face + plane - 2);
  SumFacet facet{SumFacetKind::kEdgeEdge, true, name.edge_is_of_a ? name.edge : side,
                 name.edge_is_of_a ? side : name.edge};
  return facet;
}

bool MakePrism(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
               const PrismName& name, Prism* prism) {
  const PlacedMesh& of_edge = name.edge_is_of_a ? pair.a() : pair.b();
  const PlacedMesh& of_face = name.edge_is_of_a ? pair.b() : pair.a();
  const ContactBody::Edge& edge = (name.edge_is_of_a ? a : b).edge(name.edge);
  const Vector3d &tail = of_edge.points[edge.tail], &head = of_edge.points[edge.head];
  const double sign = name.edge_is_of_a ? 1.0 : -1.0;  // of the edge's points in the sums
  const Triangle& corners = of_face.mesh.face(name.face);
  const Vector3d* const face[] = {&of_face.points[corners[0]], &of_face.points[corners[1]],
                                  &of_face.points[corners[2]]};
  const FacePlane& plane = of_face.planes[name.face];
  const Vector3d middle = sign * (0.5 * (tail + head) - (*face[0] + *face[1] + *face[2]) / 3.0);
  prism->name = name;
  const Vector3d along = head - tail;
  const auto set = [&](int k, const Vector3d& normal, double error, const Vector3d& at) {
    const double length = normal.norm();
    if (!(length > 0.0)) return false;
    Vector3d unit = normal / length;
    double height = unit.dot(at);
    const double inner = unit.dot(middle);
    if (inner > height) unit = -unit, height = -height;
    const double slack = kReach * (2.0 * error / length + 4.0 * kUnit) + kPointSlack;
    if (!(slack < kWorstSlack) || !(std::abs(inner) >= 0.0)) return false;
    prism->normals[k] = unit;
    prism->offsets[k] = height - slack;
    // The middle must be within, or the side that was taken for the inner one may not be it.
    return unit.dot(middle) < prism->offsets[k];
  };
  if (!set(0, plane.normal, plane.error, sign * (tail - *face[0])) ||
      !set(1, plane.normal, plane.error, sign * (head - *face[0]))) {
    return false;
  }
  const double along_size = along.cwiseAbs().maxCoeff();
  const double along_error = 1.01 * (2.0 * of_edge.point_error + kUnit * along_size);
  for (int k = 0; k < 3; ++k) {
    const Vector3d side = *face[(k + 1) % 3] - *face[k];
    const double side_size = side.cwiseAbs().maxCoeff();
    const double side_error = 1.01 * (2.0 * of_face.point_error + kUnit * side_size);
    // As EstimatePlane's.
    const double error =
        1.01 *
        (4.1 * kUnit * along_size * side_size +
         2.0 * (along_size * side_error + side_size * along_error + along_error * side_error));
    if (!set(2 + k, along.cross(side), error, sign * (tail - *face[k]))) return false;
  }
  return true;
}

void PrismList::Clear() {
  prisms_.clear();
  blocks_.clear();
}

int PrismList::Add(const Prism& prism) {
  const int number = size();
  const int slot = number % kWindow, lane = slot % kWidth;
  prisms_.push_back(prism);
  if (slot / kWidth >= static_cast<int>(blocks_.size())) {
    blocks_.emplace_back();
    for (auto& row : blocks_.back().offset) std::fill(row, row + kWidth, -1e300);
    for (auto& axis : blocks_.back().normal) {
      for (auto& row : axis) std::fill(row, row + kWidth, 0.0);
    }
  }
  Block& block = blocks_[slot / kWidth];
  for (int k = 0; k < kPrismPlanes; ++k) {
    for (int axis = 0; axis < 3; ++axis) block.normal[axis][k][lane] = prism.normals[k][axis];
    block.offset[k][lane] = prism.offsets[k];
  }
  return number;
}

TOUCHSTONE_VECTOR_CLONES
void PrismList::LargestMargins(std::span<const Block> blocks, const Vector3d& x,
                               double margins[kWidth], std::int64_t numbers[kWidth]) {
  double most[kWidth];
  std::int64_t of_most[kWidth];
  for (int i = 0; i < kWidth; ++i) most[i] = -1e299, of_most[i] = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block& block = blocks[b];
    double least[kWidth];
    for (int i = 0; i < kWidth; ++i) least[i] = 1e300;
    for (int k = 0; k < kPrismPlanes; ++k) {
      for (int i = 0; i < kWidth; ++i) {
        const double margin =
            block.offset[k][i] - (block.normal[0][k][i] * x[0] + block.normal[1][k][i] * x[1] +
                                  block.normal[2][k][i] * x[2]);
        least[i] = margin < least[i] ? margin : least[i];
      }
    }
    const auto number = static_cast<std::int64_t>(b);
    for (int i = 0; i < kWidth; ++i) of_most[i] = least[i] > most[i] ? number : of_most[i];
    for (int i = 0; i < kWidth; ++i) most[i] = least[i] > most[i] ? least[i] : most[i];
  }
  std::copy(most, most + kWidth, margins);
  std::copy(of_most, of_most + kWidth, numbers);
}

PrismList::Deepest PrismList::FindDeepest(const Vector3d& x) const {
  double margins[kWidth];
  std::int64_t numbers[kWidth];
  LargestMargins(blocks_, x, margins, numbers);
  int lane = 0;
  for (int i = 1; i < kWidth; ++i) lane = margins[i] > margins[lane] ? i : lane;
  if (!(margins[lane] > -1e299)) return {};
  // Slot to the latest number in it.
  const int slot = static_cast<int>(numbers[lane]) * kWidth + lane, last = size() - 1;
  return {last - (last - slot) % kWindow, margins[lane]};
}

void BallList::Clear() {
  blocks_.clear();
  added_ = 0;
  largest_ = 0.0;
}

void BallList::Add(const BurialBall& ball) {
  largest_ = std::max(largest_, ball.radius);
  const int slot = added_++ % kCapacity, lane = slot % kWidth;
  if (slot / kWidth >= static_cast<int>(blocks_.size())) {
    blocks_.emplace_back();
    for (auto& axis : blocks_.back().centre) std::fill(axis, axis + kWidth, 0.0);
    std::fill_n(blocks_.back().radius, kWidth, -1.0);
  }
  Block& block = blocks_[slot / kWidth];
  for (int axis = 0; axis < 3; ++axis) block.centre[axis][lane] = ball.centre[axis];
  block.radius[lane] = ball.radius;
}

TOUCHSTONE_VECTOR_CLONES
std::uint64_t BallList::Holding(std::span<const Block> blocks, const Vector3d& centre,
                                double radius) {
  std::uint64_t all = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block& block = blocks[b];
    std::int64_t holds[kWidth];
    for (int i = 0; i < kWidth; ++i) holds[i] = std::int64_t{1} << i;
    for (int i = 0; i < kWidth; ++i) {
      const double dx = centre[0] - block.centre[0][i], dy = centre[1] - block.centre[1][i],
                   dz = centre[2] - block.centre[2][i], rest = block.radius[i] - radius;
      holds[i] = ((rest > 0.0) & (dx * dx + dy * dy + dz * dz < rest * rest)) ? holds[i] : 0;
    }
    std::int64_t mask = 0;
    for (int i = 0; i < kWidth; ++i) mask |= holds[i];
    all |= static_cast<std::uint64_t>(mask) << (kWidth * b);
  }
  return all;
}

BurialBall BallList::ball(int i) const {
  const Block& block = blocks_[i / kWidth];
  const int lane = i % kWidth;
  return {{block.centre[0][lane], block.centre[1][lane], block.centre[2][lane]},
          block.radius[lane]};
}

std::optional<BurialBall> BallList::Find(const Vector3d& x, double least) const {
  std::optional<BurialBall> best;
  for (std::uint64_t rest = Holding(x, least); rest != 0; rest &= rest - 1) {
    const BurialBall met = ball(std::countr_zero(rest));
    const double depth = met.radius - (x - met.centre).norm();
    if (depth > least) least = depth, best = met;
  }
  return best;
}

}  // namespace touchstone::internal
