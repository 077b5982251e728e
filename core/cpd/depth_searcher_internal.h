// SPDX-License-Identifier: MIT
//
// The search for the depth: one query of it. Its stages are a file each: depth_expand, depth_list,
// depth_witness, depth_cut, depth_decide, and the order of them in depth_search.
#ifndef TOUCHSTONE_CORE_CPD_DEPTH_SEARCHER_INTERNAL_H_
#define TOUCHSTONE_CORE_CPD_DEPTH_SEARCHER_INTERNAL_H_

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <optional>

#include "touchstone/core/cpd/contact_signs_internal.h"
#include "touchstone/core/cpd/depth_search_internal.h"

namespace touchstone::internal {

// Scaled bodies are of size one.
inline constexpr double kStep = 0x1p-40;  // off a contact, far above the roundings of membership
inline constexpr double kRoundUp = 1.0 + 0x1p-50;

class DepthSearcher {
 public:
  DepthSearcher(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                const MeshDepthOptions& options, DepthScratch* scratch, MeshDepthResult* result)
      : pair_(pair), a_(a), b_(b), options_(options), s_(*scratch), result_(*result) {}

  DepthAnswer Run();

 private:
  void Reset();
  // Whether what the last query met shows that the bodies overlap where they are.
  bool IsOverlapRecalled() const;
  // Whether they do not, asked by membership.
  bool IsSeparate();
  // What moves B's box off A's along an axis: always an answer.
  void PartBoxes();
  void Take(const Eigen::Vector3d& at, const std::optional<ContactName>& name);
  Verdict VerdictAt(const Eigen::Vector3d& x);
  // Takes the cached answer's features at the new pose for a first answer, if they still are one.
  void TryRemembered();
  // Whether x, a step off the named point's contacts, is not in M°; it is taken for the answer if
  // it is nearer. If it is in M°, what shows that is kept.
  bool IsOutside(const ContactName& name, const Eigen::Vector3d& x);
  // Names come from a cache that may have served another pair.
  bool IsNameOfPair(const ContactName& name) const;
  void RecallWitnesses();
  int AddPrism(const Prism& prism);
  // The ball of the sums of the faces' balls, if it holds x (null: in any case).
  void AddBall(const Eigen::Vector3d* x, int face_a, int face_b);
  // Sets that hold x, from two faces that cross there, or from a component within the other solid.
  // Returns the depth of x in the prism.
  double AddWitness(const Eigen::Vector3d& x, int face_a, int face_b);
  // A prism that holds x by more than `least`, found next to one at hand; its number, or -1.
  int WalkFrom(int prism, const Eigen::Vector3d& x, double least);
  void AddClearance(const Eigen::Vector3d& x);
  // Pairs of faces that may cross at x give prisms, until one holds it well; for points near the
  // walls of the first ones.
  void AddAllWitnesses(const Eigen::Vector3d& x);
  // Along a slow motion the pairs of features in the way are listed once, with room for the motion
  // to go on, and only looked through afterwards.
  bool UseList();
  // Lists come from a cache that may have served another pair.
  bool IsListOfPair(const FeatureList& list) const;
  // Whether a list, complete or not, holds all that is in the way now, or at another pose.
  bool IsListFor(const RelativePose& pose, const FeatureList& list) const;
  void BeginList(const RelativePose& middle, const MotionBound& step, FeatureList* list) const;
  // Looks through so many pairs of nodes.
  void CollectItems(int most_pairs, FeatureList* list);
  // Keeps items that can come within the limit, with their own distance: spheres round large faces
  // say little.
  void MeasureItems(FeatureList* list) const;
  // A facet is no nearer than it was when it was measured, less the motion since.
  void AddItems();
  // Where the motion is about to leave the list's room the next one is made, ahead of it, in parts.
  void PrepareNextList();
  void PlaceTrees(const RelativePose& pose, double distance, double angle);
  PlacedFeatureTree& TreeA(SumKind kind);
  PlacedFeatureTree& TreeB(SumKind kind);
  // All pairs of features again, of which those within the reach are seen.
  void BeginAtRoots(double reach);
  // Beyond, no pair of features is seen.
  double Limit() const { return listed_ ? listed_->limit : std::min(reach_, answer_.upper); }
  // Whether an item was kept before that.
  bool WasMade(SumKind kind, int a, int b) const;
  // Makes all facets that may come within `radius_`, but for those made before; other pairs wait.
  void ExpandWithinRadius();
  void Expand(const NodePair& pair);
  // A pair of lanes that meet: its items, or to be expanded, now or later.
  void AddLanes(const NodePair& pair, const PlacedFeatureNode& a, int i, const PlacedFeatureNode& b,
                int j);
  void AddItem(SumKind kind, int a, int b);
  void AddEdgeEdge(int a, int b);
  void AddFacet(const SumFacet& name);
  void AddVertex(const SumVertex& vertex);
  bool IsBuried(const FacetFrame& frame, const FacetPiece& piece) const;
  const FacetFrame& FrameOf(const FacetPiece& piece) const { return s_.facets[piece.facet].frame; }
  double SlackOf(const FacetPiece& piece) const {
    return FrameOf(piece).slack + kCutSlack * piece.cuts;
  }
  double Near(const FacetPiece& piece) const {
    return std::max(0.0, piece.distance - SlackOf(piece));
  }
  // Queues a piece, unless it is further than the answer; whether it did.
  bool Push(const FacetPiece& piece);
  void Explore();
  // Whether the nearest point of the piece is not in M°: then it is the answer. Otherwise what is
  // left of the piece is queued.
  bool LookAt(const FacetPiece& piece);
  // No set at hand holds x. A step off the contacts that x stands for, by its name, mostly tells:
  // there is no overlap, and x was the answer, or there is, and what overlaps buries x, too.
  // Otherwise x itself, all faces that cross there, and big numbers are asked, in that order.
  bool Decide(const FacetPiece& piece, const Eigen::Vector3d& x);
  ContactName NameOf(const FacetPiece& piece) const;
  // Which way an edge-edge facet's normal points, by the prism's.
  void OrientWall(const Eigen::Vector3d& normal, SumFacet* facet) const;
  // Cuts off what known sets bury, or one that is next to them; whether x was among it.
  bool CutByKnown(const FacetPiece& piece, const Eigen::Vector3d& x);
  bool CutByPrism(const FacetPiece& piece, int number);
  // The ball meets the plane in a disc. A chord across the piece, such that what lies on the
  // nearest point's side is within the disc.
  bool CutByBall(const FacetPiece& piece, const BurialBall& ball);
  // Parts a piece of many corners in two.
  void Halve(const FacetPiece& piece);
  void LeaveOpen(const FacetPiece& piece, double distance);
  bool IsOutsideExactly(const ContactName& name);
  // Cuts off a small square round the nearest point, which stays open.
  void CutCrumb(const FacetPiece& piece);
  // What helps the next query.
  void Remember();
  const MeshPair& pair_;
  const ContactBody &a_, &b_;
  const MeshDepthOptions& options_;
  DepthScratch& s_;
  MeshDepthResult& result_;
  DepthAnswer answer_;
  MembershipResult last_;
  double radius_ = 0.0, reach_ = 0.0;
  std::size_t made_before_ = 0;  // of `made`: before it began at the roots again
  double open_ = std::numeric_limits<double>::infinity();
  bool found_ = false;
  bool used_list_ = false;
  FeatureList* listed_ = nullptr;  // whose items are collected
  double listed_motion_ = 0.0;     // from here to any pose in its room
  int crumbs_ = 0;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CPD_DEPTH_SEARCHER_INTERNAL_H_
