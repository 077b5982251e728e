// SPDX-License-Identifier: MIT
//
// Prisms by walking along the curve where the surfaces cross, B moved by x: at each corner of it an
// edge passes through a face, and their prism holds x. A prism at hand that x lies on the wall of
// is such a corner, so to find a better one takes a look at what is next to it instead of a
// membership.
#include <algorithm>

#include "touchstone/core/cpd/depth_searcher_internal.h"

namespace touchstone::internal {
namespace {

// Measured on the paper's scenes: 3 to 8 looks and depths and distances from 2^-12 to 2^-5 do as
// well.
constexpr int kMostLooks = 6;
constexpr double kDeepEnough = 0x1p-9;  // of x in a prism that ends the walk
constexpr double kNextTo = 0x1p-8;      // of x to a prism that the walk may go through first
constexpr std::size_t kMostCorners = 32;

// Calls visit(name) for what may be the next corner: from an edge and a face, the curve goes on
// through the faces on both sides of the edge, to another edge of theirs or one of the face's.
// Where x lies on the wall of the face's side, also past it.
template <class Visit>
void VisitNext(const MeshPair& pair, const PrismName& name, const Visit& visit) {
  const TriangleMesh& of_edge = (name.edge_is_of_a ? pair.a() : pair.b()).mesh;
  const TriangleMesh& of_face = (name.edge_is_of_a ? pair.b() : pair.a()).mesh;
  const int first = of_edge.half_edge_of(name.edge);
  for (const int h : {first, of_edge.twin(first)}) {
    visit({name.edge_is_of_a, of_edge.edge_of(TriangleMesh::next(h)), name.face});
    visit({name.edge_is_of_a, of_edge.edge_of(TriangleMesh::previous(h)), name.face});
    for (int k = 0; k < 3; ++k) {
      visit({!name.edge_is_of_a, of_face.edge_of(3 * name.face + k), TriangleMesh::face_of(h)});
    }
  }
  for (int k = 0; k < 3; ++k) {
    visit({name.edge_is_of_a, name.edge, TriangleMesh::face_of(of_face.twin(3 * name.face + k))});
  }
}

struct Corner {
  PrismName name;
  double margin;
  bool is_done = false;
};

// Corners met, the deepest of them first.
class Corners {
 public:
  explicit Corners(const Corner& first) { corners_[count_++] = first; }

  bool Has(const PrismName& name) const {
    return std::any_of(corners_, corners_ + count_,
                       [&](const Corner& c) { return c.name == name; });
  }
  void Add(const PrismName& name, double margin) {
    if (count_ < kMostCorners) corners_[count_++] = {name, margin};
  }
  // The deepest one that has not been taken; nothing if none is left.
  const Corner* Take() {
    Corner* best = nullptr;
    for (Corner* c = corners_; c != corners_ + count_; ++c) {
      if (!c->is_done && (best == nullptr || c->margin > best->margin)) best = c;
    }
    if (best != nullptr) best->is_done = true;
    return best;
  }

 private:
  Corner corners_[kMostCorners];
  std::size_t count_ = 0;
};

}  // namespace

using Eigen::Vector3d;

int DepthSearcher::WalkFrom(int number, const Vector3d& x, double least) {
  const Prism& start = s_.prisms.prism(number);
  Corners corners({start.name, start.Margin(x)});
  Prism best, next;
  double deepest = least;
  for (int look = 0; look < kMostLooks && deepest < kDeepEnough; ++look) {
    const Corner* corner = corners.Take();
    if (corner == nullptr) break;
    // Next to the start x may be on the wall of all that there is, just outside of what goes on.
    const double outside = look == 0 ? kNextTo : 0.0;
    VisitNext(pair_, corner->name, [&](const PrismName& name) {
      if (corners.Has(name) || !MakePrism(pair_, a_, b_, name, &x, &next, outside)) return;
      const double margin = next.Margin(x);
      corners.Add(name, margin);
      if (margin > deepest) deepest = margin, best = next;
    });
  }
  return deepest > least ? AddPrism(best) : -1;
}

}  // namespace touchstone::internal
