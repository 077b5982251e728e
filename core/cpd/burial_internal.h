// SPDX-License-Identifier: MIT
//
// What proves that points lie in M°: open convex sets within it.
#ifndef TOUCHSTONE_CORE_CPD_BURIAL_INTERNAL_H_
#define TOUCHSTONE_CORE_CPD_BURIAL_INTERNAL_H_

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "touchstone/core/cpd/contact_body.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/convolution.h"

namespace touchstone::internal {

// An edge of one body and a face of the other: where the edge passes through the face, the solids
// overlap, so edge ⊕ -face (or face ⊕ -edge) is a prism whose inside lies in M°.
struct PrismName {
  bool edge_is_of_a;
  int edge, face;
  friend auto operator<=>(const PrismName&, const PrismName&) = default;
};

inline constexpr int kPrismPlanes = 5;  // two ends, three sides

// In the pair's scaled frame. Points with normal . x < offset for all five lie in M°, for offsets
// that the bounds on all roundings have been taken from.
struct Prism {
  PrismName name;
  Eigen::Vector3d normals[kPrismPlanes];
  double offsets[kPrismPlanes];

  // The least of offset - normal . x: positive within.
  double Margin(const Eigen::Vector3d& x) const;
};

// Points within `radius` of `centre` lie in M°: the bodies have balls in them, or one a ball and
// the other a point, that overlap there.
struct BurialBall {
  Eigen::Vector3d centre;
  double radius;
};

// The facet whose plane bounds a prism.
SumFacet FacetOf(const MeshPair& pair, const PrismName& name, int plane);

// The prism; false where rounding leaves nothing of it.
bool MakePrism(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
               const PrismName& name, Prism* prism);

// The prisms met so far. Those of the last kWindow are searched, eight at a time.
class PrismList {
 public:
  void Clear();
  int Add(const Prism& prism);  // its number
  const Prism& prism(int i) const { return prisms_[i]; }
  int size() const { return static_cast<int>(prisms_.size()); }
  // The prism that holds x deepest, or comes nearest to it, and x's margin; -1 if there is none.
  struct Deepest {
    int number = -1;
    double margin = -1e299;
  };
  Deepest FindDeepest(const Eigen::Vector3d& x) const;

 private:
  static constexpr int kWidth = 8, kWindow = 512;
  struct alignas(64) Block {
    double normal[3][kPrismPlanes][kWidth];
    double offset[kPrismPlanes][kWidth];
  };
  // Per lane, the largest margin in any block, and its block's number.
  static void LargestMargins(std::span<const Block> blocks, const Eigen::Vector3d& x,
                             double margins[kWidth], std::int64_t numbers[kWidth]);

  std::vector<Prism> prisms_;
  std::vector<Block> blocks_;
};

// Balls met so far, the latest kCapacity of them, searched eight at a time.
class BallList {
 public:
  void Clear();
  void Add(const BurialBall& ball);
  // Whether one ball holds all points within `radius` of `centre`; no ball does unless MayHold.
  bool MayHold(double radius) const { return radius < largest_; }
  bool Holds(const Eigen::Vector3d& centre, double radius) const {
    return MayHold(radius) && Holding(centre, radius) != 0;
  }
  // The balls that do, a bit each.
  std::uint64_t Holding(const Eigen::Vector3d& centre, double radius) const {
    return Holding(blocks_, centre, radius);
  }
  // The ball that holds x deepest, if deeper than `least`.
  std::optional<BurialBall> Find(const Eigen::Vector3d& x, double least) const;

 private:
  static constexpr int kWidth = 8, kCapacity = 48;
  struct alignas(64) Block {
    double centre[3][kWidth], radius[kWidth];
  };
  static std::uint64_t Holding(std::span<const Block> blocks, const Eigen::Vector3d& centre,
                               double radius);
  BurialBall ball(int i) const;

  std::vector<Block> blocks_;
  int added_ = 0;
  double largest_ = 0.0;  // radius of those added
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CPD_BURIAL_INTERNAL_H_
