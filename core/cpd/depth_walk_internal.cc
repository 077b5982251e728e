// SPDX-License-Identifier: MIT
//
// Prisms by walking along the curve where the surfaces cross, B moved by x: at each corner of it an
// edge passes through a face, and their prism holds x. A prism at hand that x lies on the wall of
// is such a corner, so to find a better one takes a look at what is next to it instead of a
// membership.
#include <Eigen/Core>
#include <algorithm>
#include <boost/container/static_vector.hpp>

#include "touchstone/core/cpd/depth_searcher_internal.h"
#include "touchstone/core/cpd/passage_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// When a walk ends: after so many looks, or at a prism that x is so deep in. Measured on the
// paper's scenes.
struct WalkLimits {
  int looks;
  double depth;
};
constexpr WalkLimits kShortWalk = {6, 0x1p-9};
// Many pieces are many slivers in one place, which deeper prisms bury sooner.
constexpr int kManyPieces = 600;
constexpr WalkLimits kLongWalk = {24, 0x1p-7};

constexpr double kNextTo = 0x1p-8;  // of x to a prism that the walk may go through first
constexpr std::size_t kMostCorners = 128;

struct Corner {
  PrismName name;
  double margin;       // of x
  int come_from = -1;  // the face beside the edge that the curve came through
  bool is_done = false;
};

// Calls visit(next corner): from an edge and a face, the curve goes on through the faces on both
// sides of the edge, to another edge of theirs or one of the face's. Where x may lie on the wall of
// the face's side, also past it.
template <class Visit>
void VisitNext(const MeshPair& pair, const Corner& corner, const Vector3d& x, double outside,
               const Visit& visit) {
  const PrismName& name = corner.name;
  const PlacedMesh& of_edge = name.edge_is_of_a ? pair.a() : pair.b();
  const PlacedMesh& of_face = name.edge_is_of_a ? pair.b() : pair.a();
  const TriangleMesh &edges = of_edge.mesh, &faces = of_face.mesh;
  const Vector3d zero = Vector3d::Zero(), shift = name.edge_is_of_a ? x : -x;
  const MovedFace face(of_face, name.face, shift);
  const int first = edges.half_edge_of(name.edge);
  for (const int h : {first, edges.twin(first)}) {
    const int side_face = TriangleMesh::face_of(h);
    if (side_face == corner.come_from) continue;
    const MovedFace beside(of_edge, side_face, zero);
    bool has_end = false;
    VisitPassages(beside, h % 3 + 1, 2, face, outside, [&](int k, double margin) {
      visit({{name.edge_is_of_a, edges.edge_of(3 * side_face + k), name.face}, margin, side_face});
      has_end = true;
    });
    // Two triangles cross along a segment, and the corner is its other end.
    if (has_end && outside == 0.0 && corner.margin > 0.0) continue;
    VisitPassages(face, 0, 3, beside, outside, [&](int k, double margin) {
      visit({{!name.edge_is_of_a, faces.edge_of(3 * name.face + k), side_face}, margin, name.face});
    });
  }
  if (outside == 0.0) return;
  const MovedFace beside(of_edge, TriangleMesh::face_of(first), zero);
  for (int k = 0; k < 3; ++k) {
    const int past = TriangleMesh::face_of(faces.twin(3 * name.face + k));
    VisitPassages(beside, first % 3, 1, MovedFace(of_face, past, shift), outside,
                  [&](int, double margin) {
                    visit({{name.edge_is_of_a, name.edge, past}, margin});
                  });
  }
}

// Corners met.
class Corners {
 public:
  explicit Corners(const Corner& first) { corners_.push_back(first); }

  bool Has(const PrismName& name) const {
    return std::any_of(corners_.begin(), corners_.end(),
                       [&](const Corner& c) { return c.name == name; });
  }
  void Add(const Corner& corner) {
    if (corners_.size() < kMostCorners) corners_.push_back(corner);
  }
  // The deepest one that has not been taken; nothing if none is left.
  const Corner* Take() {
    Corner* best = nullptr;
    for (Corner& c : corners_) {
      if (!c.is_done && (best == nullptr || c.margin > best->margin)) best = &c;
    }
    if (best != nullptr) best->is_done = true;
    return best;
  }

 private:
  boost::container::static_vector<Corner, kMostCorners> corners_;
};

}  // namespace

int DepthSearcher::WalkFrom(int number, const Vector3d& x, double least) {
  const Prism& start = s_.prisms.prism(number);
  Corners corners({start.name, start.Margin(x)});
  PrismName best = start.name;
  double deepest = least;
  const WalkLimits& limits = result_.pieces > kManyPieces ? kLongWalk : kShortWalk;
  for (int look = 0; look < limits.looks && deepest < limits.depth; ++look) {
    const Corner* corner = corners.Take();
    if (corner == nullptr) break;
    // Next to the start x may be on the wall of all that there is, just outside of what goes on.
    const double outside = look == 0 ? kNextTo : 0.0;
    VisitNext(pair_, *corner, x, outside, [&](const Corner& next) {
      if (corners.Has(next.name)) return;
      corners.Add(next);
      if (next.margin > deepest) deepest = next.margin, best = next.name;
    });
  }
  Prism prism;
  if (!(deepest > least) || !MakePrism(pair_, a_, b_, best, &prism)) return -1;
  return prism.Margin(x) > least ? AddPrism(prism) : -1;
}

}  // namespace touchstone::internal
