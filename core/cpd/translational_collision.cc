// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/translational_collision.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

using Eigen::Vector3d;

// Facets are met if the way passes within this of them; sizes are one.
constexpr double kReach = 0x1p-44;
constexpr double kFirstBack = 0x1p-40;  // steps back from the contact double until they are safe
constexpr int kBackLimit = 30;

class Sweep {
 public:
  Sweep(const MeshPair& pair, const Vector3d& from, const Vector3d& to,
        TranslationalCollisionCache* cache, TranslationalCollisionResult* result)
      : pair_(pair),
        from_(pair.scale() * from),
        way_(pair.scale() * (to - from)),
        cache_(*cache),
        result_(*result) {}

  void Run() {
    auto& stack = cache_.stack;
    stack.clear();
    stack.emplace_back(0, 0);
    while (!stack.empty()) {
      const auto [a, b] = stack.back();
      stack.pop_back();
      Compare(a, b);
    }
  }

 private:
  struct Box {
    Vector3d low, high;
    int child;
  };

  static int LanesOf(const PlacedMesh& placed, int code, Box lanes[kTreeWidth]) {
    if (code < 0) {
      const Triangle& face = placed.mesh.face(~code);
      const Vector3d &a = placed.points[face[0]], &b = placed.points[face[1]],
                     &c = placed.points[face[2]];
      lanes[0] = {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), code};
      return 1;
    }
    const BoxNode& node = placed.tree.node(code);
    for (int lane = 0; lane < node.lane_count; ++lane) {
      for (int axis = 0; axis < 3; ++axis) {
        lanes[lane].low[axis] = node.low[axis][lane];
        lanes[lane].high[axis] = node.high[axis][lane];
      }
      lanes[lane].child = node.children[lane];
    }
    return node.lane_count;
  }

  // Whether the way, up to the first contact so far, meets the box.
  bool Meets(const Vector3d& low, const Vector3d& high) const {
    double enter = 0.0, leave = result_.fraction;
    for (int axis = 0; axis < 3; ++axis) {
      double first = low[axis] - kReach - from_[axis], last = high[axis] + kReach - from_[axis];
      if (way_[axis] == 0.0) {
        if (first > 0.0 || last < 0.0) return false;
        continue;
      }
      first /= way_[axis];
      last /= way_[axis];
      if (first > last) std::swap(first, last);
      enter = std::max(enter, first - 0x1p-50 * std::abs(first));
      leave = std::min(leave, last + 0x1p-50 * std::abs(last));
    }
    return enter <= leave;
  }

  void Compare(int code_a, int code_b) {
    ++result_.node_pairs;
    Box of_a[kTreeWidth], of_b[kTreeWidth];
    const int count_a = LanesOf(pair_.a(), code_a, of_a),
              count_b = LanesOf(pair_.b(), code_b, of_b);
    for (int i = 0; i < count_a; ++i) {
      for (int j = 0; j < count_b; ++j) {
        if (!Meets(of_a[i].low - of_b[j].high, of_a[i].high - of_b[j].low)) continue;
        if (of_a[i].child < 0 && of_b[j].child < 0) {
          Triangles(~of_a[i].child, ~of_b[j].child);
        } else {
          cache_.stack.emplace_back(of_a[i].child, of_b[j].child);
        }
      }
    }
  }

  void Triangles(int face_a, int face_b) {
    ++result_.triangle_pairs;
    const TriangleMesh &a = pair_.a().mesh, &b = pair_.b().mesh;
    const Triangle &f = a.face(face_a), &g = b.face(face_b);
    const auto &p = pair_.a().points, &q = pair_.b().points;
    for (int k = 0; k < 3; ++k) {
      const Vector3d on_a[] = {p[f[0]] - q[g[k]], p[f[1]] - q[g[k]], p[f[2]] - q[g[k]]};
      Cross(on_a, 3, {SumFacetKind::kFaceVertex, false, face_a, g[k]});
      const Vector3d on_b[] = {p[f[k]] - q[g[0]], p[f[k]] - q[g[2]], p[f[k]] - q[g[1]]};
      Cross(on_b, 3, {SumFacetKind::kVertexFace, false, f[k], face_b});
    }
    for (int k = 0; k < 3; ++k) {
      const Vector3d &p0 = p[f[k]], &p1 = p[f[(k + 1) % 3]];
      for (int l = 0; l < 3; ++l) {
        const Vector3d &q0 = q[g[l]], &q1 = q[g[(l + 1) % 3]];
        const Vector3d corners[] = {p0 - q0, p1 - q0, p1 - q1, p0 - q1};
        Cross(
            corners, 4,
            {SumFacetKind::kEdgeEdge, false, a.edge_of(3 * face_a + k), b.edge_of(3 * face_b + l)});
      }
    }
  }

  // Where the way crosses a convex polygon in a plane, if before the first contact so far.
  void Cross(const Vector3d* corners, int count, const SumFacet& facet) {
    Vector3d normal = (corners[1] - corners[0]).cross(corners[count - 1] - corners[0]);
    const double length = normal.norm();
    if (!(length > 0.0)) return;
    normal /= length;
    double rate = normal.dot(way_);
    if (facet.kind != SumFacetKind::kEdgeEdge) {
      if (rate >= 0.0) return;  // faces look outward: it would leave
    } else if (rate > 0.0) {
      normal = -normal;
      rate = -rate;
    }
    if (rate == 0.0) return;
    const double t = std::max(0.0, normal.dot(corners[0] - from_) / rate);
    if (!(t < result_.fraction)) return;
    const Vector3d x = from_ + t * way_;
    if (std::abs(normal.dot(x - corners[0])) > kReach) return;  // behind the start
    double least = 1e300, most = -1e300;
    for (int k = 0; k < count; ++k) {
      const Vector3d side = corners[(k + 1) % count] - corners[k];
      const double size = side.norm();
      if (!(size > 0.0)) continue;
      const double height = normal.dot(side.cross(x - corners[k])) / size;
      least = std::min(least, height);
      most = std::max(most, height);
    }
    if (least < -kReach && most > kReach) return;  // whichever way round the corners run
    result_.is_hit = true;
    result_.fraction = t;
    result_.features = facet;
    result_.normal = normal;
  }

  const MeshPair& pair_;
  const Vector3d from_, way_;
  TranslationalCollisionCache& cache_;
  TranslationalCollisionResult& result_;
};

}  // namespace

TranslationalCollisionResult TranslationalCollision(const MeshPair& pair, const Vector3d& from,
                                                    const Vector3d& to,
                                                    TranslationalCollisionCache* cache) {
  TranslationalCollisionCache own;
  if (cache == nullptr) cache = &own;
  TranslationalCollisionResult result;
  const Vector3d way = to - from;
  Sweep(pair, from, to, cache, &result).Run();
  const double length = pair.scale() * way.norm();
  double back = length > 0.0 ? kFirstBack / length : 0.0;
  for (int i = 0; i < kBackLimit; ++i, back *= 2.0) {
    const double fraction = result.is_hit ? std::max(0.0, result.fraction - back) : 1.0;
    const Vector3d x = from + fraction * way;
    if (Membership(pair, x, {}, &cache->membership).verdict != Verdict::kOverlap) {
      result.safe_fraction = fraction;
      break;
    }
    // A way without a contact that ends in an overlap began in one, or slipped through.
    result.is_hit = true;
    if (fraction == 0.0) break;
  }
  return result;
}

}  // namespace touchstone
