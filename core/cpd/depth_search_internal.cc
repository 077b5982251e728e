// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/depth_search_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "touchstone/core/mesh/inner_balls.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Scaled bodies are of size one; see below for what each is taken from.
constexpr double kStep = 0x1p-40;        // off a contact, far above the roundings of membership
constexpr double kCrumb = 0x1p-34;       // half the side of what is left open where nothing decides
constexpr double kClosed = 4.0 * kStep;  // bounds that differ by steps alone
constexpr int kCrumbLimit = 32;          // then too much is left open to go on
constexpr double kNameDistance = 0x1p-24;  // a name further off than this is not the point's
constexpr double kGrowth = 1.5;            // of the radius within which facets are made
constexpr double kRoundUp = 1.0 + 0x1p-50;
// R may be off orthonormal by 1e-6: balls become ellipsoids.
constexpr double kBallShrink = 1.0 - 4e-6;
constexpr double kListFrames = 8.0;  // steps of a motion that a list has room for
constexpr double kListAngle = 0.06;  // beyond, lists would hold too much
constexpr std::size_t kRememberedPrisms = 128;
constexpr std::size_t kRememberedBalls = 16;

class Search {
 public:
  Search(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
         const MeshDepthOptions& options, DepthScratch* scratch, MeshDepthResult* result)
      : pair_(pair), a_(a), b_(b), options_(options), s_(*scratch), result_(*result) {}

  DepthAnswer Run() {
    Reset();
    const MembershipResult at_origin =
        Membership(pair_, Vector3d(Vector3d::Zero()), {options_.certainty}, &s_.membership);
    if (at_origin.verdict == Verdict::kSeparate || at_origin.verdict == Verdict::kTouch) {
      answer_.status = MeshDepthStatus::kSeparate;
      answer_.upper = 0.0;
      return answer_;
    }
    PartBoxes();
    TryRemembered();
    RecallWitnesses();
    if (at_origin.verdict == Verdict::kOverlap) {
      AddWitness(Vector3d::Zero(), at_origin.face_a, at_origin.face_b);
    }
    Explore();
    Remember();
    return answer_;
  }

 private:
  // --- bounds ---

  void Reset() {
    s_.stack.clear();
    s_.later.clear();
    s_.facets.clear();
    s_.pieces.clear();
    s_.free_pieces.clear();
    s_.heap.clear();
    s_.prism_uses.clear();
    s_.prisms.Clear();
    s_.balls.Clear();
    answer_.status = MeshDepthStatus::kCertain;
  }

  // What moves B's box off A's along an axis: always an answer.
  void PartBoxes() {
    const Vector3d low_a = pair_.a().tree.low(), high_a = pair_.a().tree.high(),
                   low_b = pair_.b().tree.low(), high_b = pair_.b().tree.high();
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step : {high_a[axis] - low_b[axis], low_a[axis] - high_b[axis]}) {
        const double length = std::abs(step) + 0x1p-46;
        if (length * kRoundUp < answer_.upper) {
          Take(std::copysign(length, step) * Vector3d::Unit(axis), std::nullopt);
        }
      }
    }
  }

  void Take(const Vector3d& at, const std::optional<ContactName>& name) {
    answer_.at = at;
    answer_.at_error = 0.0;
    answer_.upper = at.norm() * kRoundUp;
    answer_.name = name;
    answer_.is_exact = false;
  }

  Verdict VerdictAt(const Vector3d& x) {
    ++result_.memberships;
    last_ = Membership(pair_, Vector3d(x / pair_.scale()), {Certainty::kFloat}, &s_.membership);
    return last_.verdict;
  }

  // Takes the cached answer's features at the new pose for a first answer, if they still are one.
  void TryRemembered() {
    if (!s_.answer || !IsNameOfPair(*s_.answer)) return;
    const auto point = EstimatePoint(pair_, *s_.answer);
    if (point) answer_.was_warm = IsOutside(*s_.answer, *point);
  }

  // Whether a point a step off the named one's contacts is not in M°; it is taken for the answer if
  // it is nearer. If it is in M°, what shows that is kept.
  bool IsOutside(const ContactName& name, const PointEstimate& point) {
    for (const Vector3d& out : {point.out, Vector3d(point.at.stableNormalized())}) {
      const Vector3d x = point.at + kStep * out;
      if (!x.allFinite()) continue;
      const Verdict verdict = VerdictAt(x);
      if (verdict == Verdict::kOverlap) AddWitness(x, last_.face_a, last_.face_b);
      if (verdict != Verdict::kSeparate) continue;
      if (x.norm() * kRoundUp < answer_.upper) Take(x, name);
      return true;
    }
    return false;
  }

  // Names come from a cache that may have served another pair.
  bool IsNameOfPair(const ContactName& name) const {
    const TriangleMesh &a = pair_.a().mesh, &b = pair_.b().mesh;
    const auto is_vertex = [&](const SumVertex& v) {
      return v.a >= 0 && v.a < a.vertex_count() && v.b >= 0 && v.b < b.vertex_count();
    };
    const auto is_facet = [&](const SumFacet& f) {
      const bool face_a = f.kind == SumFacetKind::kFaceVertex,
                 face_b = f.kind == SumFacetKind::kVertexFace;
      const int count_a = face_a ? a.face_count() : face_b ? a.vertex_count() : a.edge_count();
      const int count_b = face_b ? b.face_count() : face_a ? b.vertex_count() : b.edge_count();
      return f.a >= 0 && f.a < count_a && f.b >= 0 && f.b < count_b;
    };
    if (name.is_vertex) return is_vertex(name.vertex);
    if (!is_facet(name.facet)) return false;
    for (int k = 0; k < name.wall_count; ++k) {
      const ContactWall& wall = name.walls[k];
      if (wall.is_edge ? !is_vertex(wall.from) || !is_vertex(wall.to) : !is_facet(wall.facet)) {
        return false;
      }
    }
    return true;
  }

  // --- witnesses ---

  void RecallWitnesses() {
    for (const auto& [f, g] : s_.ball_faces) AddBall(nullptr, f, g);
    Prism prism;
    for (const PrismName& name : s_.prism_names) {
      const TriangleMesh& of_edge = (name.edge_is_of_a ? pair_.a() : pair_.b()).mesh;
      const TriangleMesh& of_face = (name.edge_is_of_a ? pair_.b() : pair_.a()).mesh;
      if (name.edge >= of_edge.edge_count() || name.face >= of_face.face_count()) continue;
      if (MakePrism(pair_, a_, b_, name, nullptr, &prism)) AddPrism(prism);
    }
  }

  int AddPrism(const Prism& prism) {
    s_.prism_uses.push_back(0);
    ++result_.prisms;
    return s_.prisms.Add(prism);
  }

  // The ball of the sums of the faces' balls, if it holds x (null: in any case).
  void AddBall(const Vector3d* x, int face_a, int face_b) {
    if (face_a >= pair_.a().mesh.face_count() || face_b >= pair_.b().mesh.face_count()) return;
    const InnerBall &p = a_.ball(face_a), &q = b_.ball(face_b);
    if (p.radius <= 0.0 || q.radius <= 0.0) return;
    const double scale = pair_.scale();
    const Vector3d centre = scale * p.centre - (pair_.pose().rotation() * (scale * q.centre) +
                                                scale * pair_.pose().translation());
    const double radius = kBallShrink * scale * (p.radius + q.radius) - 0x1p-46;
    if (!(radius > 0.0)) return;
    if (x != nullptr && (*x - centre).norm() >= radius) return;
    ++result_.balls;
    s_.balls.Add({centre, radius});
    met_balls_.emplace_back(face_a, face_b);
  }

  // Sets that hold x, from two faces that cross there, or from a component within the other solid.
  void AddWitness(const Vector3d& x, int face_a, int face_b) {
    if (face_a < 0) {
      AddClearance(x);
      return;
    }
    AddBall(&x, face_a, face_b);
    double best = 0.0;
    Prism prism, best_prism;
    for (int k = 0; k < 6; ++k) {
      const bool is_of_a = k < 3;
      const TriangleMesh& mesh = (is_of_a ? pair_.a() : pair_.b()).mesh;
      const PrismName name = {is_of_a, mesh.edge_of(3 * (is_of_a ? face_a : face_b) + k % 3),
                              is_of_a ? face_b : face_a};
      if (!MakePrism(pair_, a_, b_, name, &x, &prism)) continue;
      const double margin = prism.Margin(x);
      if (margin > best) best = margin, best_prism = prism;
    }
    if (best > 0.0) AddPrism(best_prism);
  }

  void AddClearance(const Vector3d& x) {
    const double error = 2.0 * (pair_.a().point_error + pair_.b().point_error) + 0x1p-48;
    const auto try_components = [&](const PlacedMesh& inner, const PlacedMesh& outer, double sign) {
      for (const MeshComponent& component : inner.mesh.components()) {
        const Vector3d at = inner.points[inner.mesh.face(component.first_face)[0]] + sign * x;
        const auto radius = InnerClearance(outer, at, error);
        if (!radius) continue;
        ++result_.balls;
        s_.balls.Add({x, *radius});
      }
    };
    try_components(pair_.a(), pair_.b(), -1.0);
    try_components(pair_.b(), pair_.a(), 1.0);
  }

  // All pairs of faces that may cross at x give prisms; for the rare point near the walls of the
  // first ones.
  void AddAllWitnesses(const Vector3d& x) {
    s_.membership.stack.clear();
    s_.membership.stack.emplace_back(0, 0);
    auto& stack = s_.membership.stack;
    const BoxTree &tree_a = pair_.a().tree, &tree_b = pair_.b().tree;
    while (!stack.empty()) {
      const auto [i, j] = stack.back();
      stack.pop_back();
      // Faces are compared with nodes lane by lane.
      BoxNode single;
      const auto as_node = [&](const PlacedMesh& placed, const BoxTree& tree,
                               int index) -> const BoxNode& {
        if (index >= 0) return tree.node(index);
        const Triangle& face = placed.mesh.face(~index);
        for (int axis = 0; axis < 3; ++axis) {
          const auto [low, high] =
              std::minmax({placed.points[face[0]][axis], placed.points[face[1]][axis],
                           placed.points[face[2]][axis]});
          for (int lane = 0; lane < kTreeWidth; ++lane) {
            single.low[axis][lane] = lane == 0 ? low : 1e300;
            single.high[axis][lane] = lane == 0 ? high : -1e300;
          }
        }
        for (int lane = 0; lane < kTreeWidth; ++lane) single.children[lane] = index;
        single.lane_count = 1;
        return single;
      };
      const BoxNode& node_a = as_node(pair_.a(), tree_a, i);
      const BoxNode& node_b = as_node(pair_.b(), tree_b, j);
      std::uint8_t masks[kTreeWidth];
      MeetingLanes(node_a, node_b, x, 0x1p-46, masks);
      for (int lane = 0; lane < node_b.lane_count; ++lane) {
        for (unsigned mask = masks[lane]; mask != 0; mask &= mask - 1) {
          const int of_a = node_a.children[std::countr_zero(mask)], of_b = node_b.children[lane];
          if (of_a < 0 && of_b < 0) {
            AddWitness(x, ~of_a, ~of_b);
          } else {
            stack.emplace_back(of_a, of_b);
          }
        }
      }
    }
  }

  // --- facets ---

  // How far B's points move from another pose, scaled, and how far it turns, at most: a matrix's
  // Frobenius norm bounds what it does to a unit vector, and is sqrt 2 times a small turn.
  struct Motion {
    double distance, angle;
  };
  Motion MotionFrom(const RelativePose& other) const {
    const double turn = (pair_.pose().rotation() - other.rotation()).norm();
    const double shift = (pair_.pose().translation() - other.translation()).norm();
    return {pair_.scale() * (1.7321 * turn * b_.mesh().max_coordinate() + shift) * kRoundUp, turn};
  }

  // Along a slow motion the pairs of features in the way are listed once, with room for the motion
  // to go on, and only looked through afterwards.
  bool UseList() {
    FeatureList& list = s_.list;
    const bool is_of_these = list.a && list.b && list.a->IsSameAs(a_) && list.b->IsSameAs(b_) &&
                             list.scale == pair_.scale();
    if (is_of_these && answer_.upper <= list.limit) {
      const Motion motion = MotionFrom(list.pose);
      if (motion.distance <= list.distance && motion.angle <= list.angle) {
        AddItems();
        return true;
      }
    }
    if (!answer_.was_warm || !s_.pose) return false;
    const Motion step = MotionFrom(*s_.pose);
    if (!(kListFrames * step.angle < kListAngle)) return false;
    list.a = a_;
    list.b = b_;
    list.pose = pair_.pose();
    list.scale = pair_.scale();
    list.distance = kListFrames * step.distance + 0x1p-40;
    list.angle = kListFrames * step.angle + 0x1p-40;
    list.limit = 1.02 * answer_.upper + list.distance;
    list.items.clear();
    PlaceTrees(list.distance, list.angle);
    is_listing_ = true;
    radius_ = list.limit;
    ExpandWithinRadius();
    is_listing_ = false;
    s_.later.clear();
    AddItems();
    return true;
  }

  void AddItems() {
    radius_ = answer_.upper;
    for (const NodePair& item : s_.list.items) AddItem(item.kind, item.a, item.b);
  }

  void PlaceTrees(double distance, double angle) {
    const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
    const Vector3d zero = Vector3d::Zero();
    const double scale = pair_.scale();
    s_.faces_a.Place(a_.faces(), identity, zero, scale);
    s_.vertices_a.Place(a_.vertices(), identity, zero, scale);
    s_.edges_a.Place(a_.convex_edges(), identity, zero, scale);
    s_.hollows_a.Place(a_.hollow_vertices(), identity, zero, scale);
    const Eigen::Matrix3d& rotation = pair_.pose().rotation();
    const Vector3d& translation = pair_.pose().translation();
    s_.faces_b.Place(b_.faces(), rotation, translation, scale, distance, angle);
    s_.vertices_b.Place(b_.vertices(), rotation, translation, scale, distance, angle);
    s_.edges_b.Place(b_.convex_edges(), rotation, translation, scale, distance, angle);
    s_.hollows_b.Place(b_.hollow_vertices(), rotation, translation, scale, distance, angle);
    for (const SumKind kind :
         {SumKind::kFaceVertex, SumKind::kVertexFace, SumKind::kEdgeEdge, SumKind::kVertexVertex}) {
      if (!TreeA(kind).empty() && !TreeB(kind).empty()) s_.later.push_back({0.0, kind, 0, 0});
    }
  }

  PlacedFeatureTree& TreeA(SumKind kind) {
    switch (kind) {
      case SumKind::kFaceVertex:
        return s_.faces_a;
      case SumKind::kVertexFace:
        return s_.vertices_a;
      case SumKind::kEdgeEdge:
        return s_.edges_a;
      case SumKind::kVertexVertex:
        break;
    }
    return s_.hollows_a;
  }
  PlacedFeatureTree& TreeB(SumKind kind) {
    switch (kind) {
      case SumKind::kFaceVertex:
        return s_.vertices_b;
      case SumKind::kVertexFace:
        return s_.faces_b;
      case SumKind::kEdgeEdge:
        return s_.edges_b;
      case SumKind::kVertexVertex:
        break;
    }
    return s_.hollows_b;
  }

  // Makes all facets that may come within `radius_`; other pairs wait.
  void ExpandWithinRadius() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < s_.later.size(); ++i) {
      if (!is_listing_ && s_.later[i].near >= answer_.upper) continue;
      if (s_.later[i].near < radius_) {
        s_.stack.push_back(s_.later[i]);
      } else {
        s_.later[kept++] = s_.later[i];
      }
    }
    s_.later.resize(kept);
    while (!s_.stack.empty()) {
      const NodePair pair = s_.stack.back();
      s_.stack.pop_back();
      Expand(pair);
    }
  }

  static const FeatureNode& NodeOf(PlacedFeatureTree& tree, int code, FeatureNode* alone) {
    if (code >= 0) return tree.node(code);
    *alone = LaneAlone(tree.node(~code / kFeatureTreeWidth), ~code % kFeatureTreeWidth);
    return *alone;
  }

  void Expand(const NodePair& pair) {
    ++result_.node_pairs;
    FeatureNode alone_a, alone_b;
    const FeatureNode& node_a = NodeOf(TreeA(pair.kind), pair.a, &alone_a);
    const FeatureNode& node_b = NodeOf(TreeB(pair.kind), pair.b, &alone_b);
    std::uint8_t masks[kFeatureTreeWidth];
    const double limit = is_listing_ ? s_.list.limit : answer_.upper;
    // Whatever the motion does, a ball and a facet move by no more than the distance each.
    const double margin = is_listing_ ? s_.list.distance : 0.0;
    MeetingFeatures(node_a, node_b, limit, pair.kind != SumKind::kVertexVertex, masks);
    for (int j = 0; j < node_b.lane_count; ++j) {
      for (unsigned mask = masks[j]; mask != 0; mask &= mask - 1) {
        const int i = std::countr_zero(mask);
        const int child_a = node_a.children[i], child_b = node_b.children[j];
        const bool is_item = child_a < 0 && child_b < 0;
        const Vector3d centre(node_a.centre[0][i] - node_b.centre[0][j],
                              node_a.centre[1][i] - node_b.centre[1][j],
                              node_a.centre[2][i] - node_b.centre[2][j]);
        const double radius = node_a.radius[i] + node_b.radius[j];
        const double near = centre.norm() - radius;
        if (s_.balls.Holds(centre, radius + margin)) continue;
        if (is_item && near < radius_) {
          if (is_listing_) {
            s_.list.items.push_back({near, pair.kind, ~child_a, ~child_b});
          } else {
            AddItem(pair.kind, ~child_a, ~child_b);
          }
          continue;
        }
        const NodePair next = {near, pair.kind,
                               child_a >= 0 ? child_a
                               : pair.a < 0 ? pair.a
                                            : ~(kFeatureTreeWidth * pair.a + i),
                               child_b >= 0 ? child_b
                               : pair.b < 0 ? pair.b
                                            : ~(kFeatureTreeWidth * pair.b + j)};
        (next.near < radius_ ? s_.stack : s_.later).push_back(next);
      }
    }
  }

  // The sign of a face's exterior normal along a difference of points of the other body; 0: doubles
  // cannot tell.
  static int AlongNormal(const PlacedMesh& own, int face, const PlacedMesh& other, int to,
                         int from) {
    const FacePlane& plane = own.planes[face];
    const Vector3d difference = other.points[to] - other.points[from];
    const double error =
        1.01 * (2.0 * other.point_error + kUnit * difference.cwiseAbs().maxCoeff());
    return TriageSign(HeightAlong(plane.normal, plane.error, difference, error));
  }

  // Whether doubles leave it open that the vertex's solid lies on the outer side of the face.
  static bool MayRest(const PlacedMesh& own, int face, const PlacedMesh& other, const GaussMap& map,
                      int vertex) {
    if (map.vertex_kind(vertex) == VertexKind::kCorner) {
      for (const int w : map.essential_neighbors(vertex)) {
        if (AlongNormal(own, face, other, w, vertex) < 0) return false;
      }
      return true;
    }
    for (const int h : other.mesh.vertex_half_edges(vertex)) {
      if (AlongNormal(own, face, other, other.mesh.head(h), vertex) < 0) return false;
    }
    return true;
  }

  void AddItem(SumKind kind, int a, int b) {
    switch (kind) {
      case SumKind::kFaceVertex:
        if (MayRest(pair_.a(), a, pair_.b(), b_.gauss_map(), b)) {
          AddFacet({SumFacetKind::kFaceVertex, false, a, b});
        }
        return;
      case SumKind::kVertexFace:
        if (MayRest(pair_.b(), b, pair_.a(), a_.gauss_map(), a)) {
          AddFacet({SumFacetKind::kVertexFace, false, a, b});
        }
        return;
      case SumKind::kEdgeEdge:
        AddEdgeEdge(a, b);
        return;
      case SumKind::kVertexVertex:
        AddVertex({a, b});
        return;
    }
  }

  // As SupportSigns::EdgeEdge of core/minkowski, where signs that doubles leave open count as met;
  // both senses are taken if none is certain.
  //
  // Exactly parallel edges span no area: what they have of ∂M is on other facets.
  void AddEdgeEdge(int a, int b) {
    const ContactBody::Edge &p = a_.edge(a), &q = b_.edge(b);
    const int left_a = AlongNormal(pair_.a(), p.left, pair_.b(), q.head, q.tail);
    const int right_a = AlongNormal(pair_.a(), p.right, pair_.b(), q.head, q.tail);
    if (left_a * right_a > 0) return;
    const int left_b = AlongNormal(pair_.b(), q.left, pair_.a(), p.head, p.tail);
    const int right_b = AlongNormal(pair_.b(), q.right, pair_.a(), p.head, p.tail);
    if (left_b * right_b > 0) return;
    if (left_a * right_a == 0 && left_b * right_b == 0 && AreParallel(p, q)) return;
    for (const int sense : {1, -1}) {
      if (sense * left_a < 0 || sense * right_a > 0 || sense * left_b < 0 || sense * right_b > 0) {
        continue;
      }
      AddFacet({SumFacetKind::kEdgeEdge, sense > 0, a, b});
    }
  }

  bool AreParallel(const ContactBody::Edge& p, const ContactBody::Edge& q) const {
    ExactMeshPair exact(pair_);
    const DyadicVector cross = Cross(exact.PointOfA(p.head) - exact.PointOfA(p.tail),
                                     exact.PointOfB(q.head) - exact.PointOfB(q.tail));
    return cross[0].sign() == 0 && cross[1].sign() == 0 && cross[2].sign() == 0;
  }

  void AddFacet(const SumFacet& name) {
    s_.facets.emplace_back();
    MetFacet& facet = s_.facets.back();
    FacetPiece piece;
    MakeFacet(pair_, name, &facet.frame, &piece);
    piece.facet = static_cast<int>(s_.facets.size()) - 1;
    ++result_.facets;
    const bool faces_away = facet.frame.is_oriented && facet.frame.height < -facet.frame.slack;
    if (faces_away || IsBuried(facet.frame, piece) || !Push(piece)) {
      s_.facets.pop_back();
    }
  }

  void AddVertex(const SumVertex& vertex) {
    const Vector3d x = EstimateVertex(pair_, vertex);
    s_.facets.emplace_back();
    MetFacet& facet = s_.facets.back();
    facet.is_vertex = true;
    facet.vertex = vertex;
    FacetFrame& frame = facet.frame;
    frame.normal = x.norm() > 0.0 ? Vector3d(x.normalized()) : Vector3d::UnitZ();
    frame.u = frame.normal.unitOrthogonal();
    frame.v = frame.normal.cross(frame.u);
    frame.height = x.norm();
    frame.slack = 0x1p-45 + 2.0 * (pair_.a().point_error + pair_.b().point_error);
    FacetPiece piece;
    piece.facet = static_cast<int>(s_.facets.size()) - 1;
    piece.count = 1;
    piece.at[0] = Vector2d::Zero();
    piece.walls[0] = kNoWall;
    piece.distance = frame.height;
    ++result_.facets;
    if (IsBuried(frame, piece) || !Push(piece)) s_.facets.pop_back();
  }

  bool IsBuried(const FacetFrame& frame, const FacetPiece& piece) const {
    Vector3d corners[kMaxPieceCorners];
    for (int i = 0; i < piece.count; ++i) corners[i] = frame.At(piece.at[i]);
    return s_.balls.Holds(std::span<const Vector3d>(corners, piece.count), SlackOf(piece));
  }

  const FacetFrame& FrameOf(const FacetPiece& piece) const { return s_.facets[piece.facet].frame; }

  double SlackOf(const FacetPiece& piece) const {
    return FrameOf(piece).slack + kCutSlack * piece.cuts;
  }

  double Near(const FacetPiece& piece) const {
    return std::max(0.0, piece.distance - SlackOf(piece));
  }

  // Queues a piece, unless it is further than the answer; whether it did.
  bool Push(const FacetPiece& piece) {
    const double near = Near(piece);
    if (near >= answer_.upper) return false;
    int slot;
    if (s_.free_pieces.empty()) {
      slot = static_cast<int>(s_.pieces.size());
      s_.pieces.push_back(piece);
    } else {
      slot = s_.free_pieces.back();
      s_.free_pieces.pop_back();
      s_.pieces[slot] = piece;
    }
    s_.heap.emplace_back(near, slot);
    std::push_heap(s_.heap.begin(), s_.heap.end(), std::greater<>());
    return true;
  }

  // --- pieces ---

  void Explore() {
    if (!UseList()) {
      PlaceTrees(0.0, 0.0);
      radius_ = answer_.was_warm ? answer_.upper : 0.0625 * answer_.upper;
      ExpandWithinRadius();
    }
    while (true) {
      const double near = s_.heap.empty() ? radius_ : s_.heap.front().first;
      if (near >= radius_ || s_.heap.empty()) {
        if (radius_ >= answer_.upper) break;
        radius_ = std::min(answer_.upper, std::max(kGrowth * radius_, 1.01 * near));
        ExpandWithinRadius();
        continue;
      }
      if (near >= answer_.upper - kClosed) break;
      if (crumbs_ >= kCrumbLimit) break;
      if (result_.pieces >= options_.piece_limit) {
        answer_.status = MeshDepthStatus::kLimit;
        answer_.lower = std::min(open_, near);
        return;
      }
      ++result_.pieces;
      std::pop_heap(s_.heap.begin(), s_.heap.end(), std::greater<>());
      const int slot = s_.heap.back().second;
      s_.heap.pop_back();
      const FacetPiece piece = s_.pieces[slot];
      s_.free_pieces.push_back(slot);
      if (LookAt(piece)) {
        answer_.lower = std::min(near, answer_.upper);
        break;
      }
      answer_.lower = near;
    }
    const double next = s_.heap.empty() ? answer_.upper : s_.heap.front().first;
    if (!found_) answer_.lower = std::min(answer_.upper, next);
    if (open_ < answer_.lower) {
      answer_.lower = open_;
      answer_.status = MeshDepthStatus::kOpen;
    }
  }

  // Whether the nearest point of the piece is not in M°: then it is the answer. Otherwise what is
  // left of the piece is queued.
  bool LookAt(const FacetPiece& piece) {
    const FacetFrame& frame = FrameOf(piece);
    if (IsBuried(frame, piece)) return false;
    if (piece.count >= kMaxPieceCorners - 1) {
      Halve(piece);
      return false;
    }
    const NearestPoint nearest = NearestOf(piece);
    const Vector3d x = frame.At(nearest.at);
    if (piece.cuts < kMaxCuts && CutByKnown(piece, nearest, x)) return false;
    return Decide(piece, nearest, x);
  }

  // No set at hand holds x. A step off the contacts that x stands for, by its name, mostly tells:
  // there is no overlap, and x was the answer, or there is, and what overlaps buries x, too.
  // Otherwise x itself, all faces that cross there, and big numbers are asked, in that order.
  bool Decide(const FacetPiece& piece, const NearestPoint& nearest, const Vector3d& x) {
    const ContactName name = NameOf(piece, nearest);
    const auto point = EstimatePoint(pair_, name);
    const bool is_near = point && (point->at - x).norm() < kNameDistance;
    if (is_near && IsOutside(name, *point)) return found_ = true;
    const bool may_cut = piece.cuts < kMaxCuts;
    if (is_near && may_cut && CutByKnown(piece, nearest, x)) return false;
    const Verdict verdict = VerdictAt(x);
    if (verdict == Verdict::kSeparate) {
      Take(x, name);
      return found_ = true;
    }
    if (verdict == Verdict::kOverlap && may_cut) {
      AddWitness(x, last_.face_a, last_.face_b);
      if (CutByKnown(piece, nearest, x)) return false;
      AddAllWitnesses(x);
      if (CutByKnown(piece, nearest, x)) return false;
    }
    if (is_near && options_.certainty == Certainty::kExact && IsOutsideExactly(name)) {
      return found_ = true;
    }
    LeaveOpen(piece, piece.distance);
    CutCrumb(piece, nearest);
    return false;
  }

  ContactName NameOf(const FacetPiece& piece, const NearestPoint& nearest) const {
    const MetFacet& facet = s_.facets[piece.facet];
    ContactName name;
    if (facet.is_vertex) {
      name.is_vertex = true;
      name.vertex = facet.vertex;
      return name;
    }
    name.facet = facet.frame.name;
    const SumCorners& corners = facet.frame.corners;
    for (int k = 0; k < nearest.wall_count; ++k) {
      const int wall = nearest.walls[k];
      if (wall == kNoWall) continue;
      ContactWall& out = name.walls[name.wall_count++];
      if (wall >= 0) {
        out.facet = FacetOf(pair_, s_.prisms.prism(wall / kPrismPlanes).name, wall % kPrismPlanes);
        OrientWall(s_.prisms.prism(wall / kPrismPlanes).normals[wall % kPrismPlanes], &out.facet);
      } else {
        const int side = -1 - wall;
        out.is_edge = true;
        out.from = corners.vertices[side];
        out.to = corners.vertices[(side + 1) % corners.count];
      }
    }
    if (name.wall_count == 2 && name.walls[0].is_edge && name.walls[1].is_edge) {
      // Two sides of the facet meet in a corner of it.
      const ContactWall &p = name.walls[0], &q = name.walls[1];
      name.is_vertex = true;
      name.vertex = p.from == q.from || p.from == q.to ? p.from : p.to;
    }
    return name;
  }

  // Which way an edge-edge facet's normal points, by the prism's.
  void OrientWall(const Vector3d& normal, SumFacet* facet) const {
    if (facet->kind != SumFacetKind::kEdgeEdge) return;
    facet->is_along_cross = EstimatePlane(pair_, *facet).normal.dot(normal) > 0.0;
  }

  // Cuts off what known sets bury; whether x was among it.
  bool CutByKnown(const FacetPiece& piece, const NearestPoint& nearest, const Vector3d& x) {
    const double least = 4.0 * SlackOf(piece);
    const BurialBall* ball = s_.balls.Find(x, 1e-3);
    if (ball != nullptr && CutByBall(piece, nearest, *ball)) return true;
    const int prism = s_.prisms.Find(x, least);
    if (prism >= 0 && CutByPrism(piece, prism)) return true;
    ball = s_.balls.Find(x, least);
    return ball != nullptr && CutByBall(piece, nearest, *ball);
  }

  bool CutByPrism(const FacetPiece& piece, int number) {
    const Prism& prism = s_.prisms.prism(number);
    const FacetFrame& frame = FrameOf(piece);
    const double slack = SlackOf(piece);
    FacetPiece rest = piece, parts[kPrismPlanes];
    int count = 0;
    for (int k = 0; k < kPrismPlanes; ++k) {
      if (rest.count >= kMaxPieceCorners) {
        Halve(piece);
        return true;
      }
      const Vector3d& normal = prism.normals[k];
      const Line2 line = {normal.dot(frame.u), normal.dot(frame.v),
                          prism.offsets[k] - frame.height * normal.dot(frame.normal) - slack};
      FacetPiece in, out;
      Part(rest, line, kPrismPlanes * number + k, &in, &out);
      if (in.count == 0) return false;
      if (out.count > 0) parts[count++] = out;
      rest = in;
    }
    ++s_.prism_uses[number];
    for (int k = 0; k < count; ++k) {
      Measure(frame, &parts[k]);
      Push(parts[k]);
    }
    return true;
  }

  // The ball meets the plane in a disc. A chord across the piece, such that what lies on the
  // nearest point's side is within the disc.
  bool CutByBall(const FacetPiece& piece, const NearestPoint& nearest, const BurialBall& ball) {
    const FacetFrame& frame = FrameOf(piece);
    const double radius = ball.radius - 2.0 * SlackOf(piece);
    const double height = frame.normal.dot(ball.centre) - frame.height;
    const double squared = radius * radius - height * height;
    if (!(radius > 0.0) || !(squared > 0.0)) return false;
    const Vector2d centre(frame.u.dot(ball.centre), frame.v.dot(ball.centre));
    Vector2d middle = Vector2d::Zero();
    for (int i = 0; i < piece.count; ++i) middle += piece.at[i] / piece.count;
    const Vector2d across = middle - nearest.at;
    const double length = across.norm();
    if (!(length > 0.0)) return (nearest.at - centre).squaredNorm() < squared;
    const Vector2d along = across / length;
    double least = 1e300;
    for (int i = 0; i < piece.count; ++i) {
      const Vector2d &p = piece.at[i], &q = piece.at[i + 1 == piece.count ? 0 : i + 1];
      const bool p_in = (p - centre).squaredNorm() < squared,
                 q_in = (q - centre).squaredNorm() < squared;
      if (!p_in) least = std::min(least, along.dot(p));
      if (p_in == q_in) continue;
      // Where the side leaves the disc, from the end within.
      const Vector2d from = p_in ? p : q, step = p_in ? Vector2d(q - p) : Vector2d(p - q);
      const Vector2d at = from - centre;
      const double a = step.squaredNorm(), b = at.dot(step), c = at.squaredNorm() - squared;
      const double t = (-b + std::sqrt(std::max(0.0, b * b - a * c))) / a;
      least = std::min(least, along.dot(from + std::min(t, 1.0) * step));
    }
    const double gain = least - along.dot(nearest.at);
    if (least > 1e299) return true;  // all corners within
    if (!(gain > 0.05 * length)) return false;
    FacetPiece in, out;
    Part(piece, {along[0], along[1], least - 0x1p-40}, kNoWall, &in, &out);
    if (in.count == 0) return false;
    if (out.count > 0) {
      Measure(frame, &out);
      Push(out);
    }
    return true;
  }

  // Parts a piece of many corners in two.
  void Halve(const FacetPiece& piece) {
    const Vector2d &p = piece.at[0], &q = piece.at[piece.count / 2];
    const Vector2d normal(q[1] - p[1], p[0] - q[0]);
    FacetPiece halves[2];
    Part(piece, {normal[0], normal[1], normal.dot(p)}, kNoWall, &halves[0], &halves[1]);
    if (halves[0].count == 0 || halves[1].count == 0) {
      LeaveOpen(piece, piece.distance);
      return;
    }
    for (FacetPiece& half : halves) {
      Measure(FrameOf(half), &half);
      Push(half);
    }
  }

  void LeaveOpen(const FacetPiece& piece, double distance) {
    open_ = std::min(open_, std::max(0.0, distance - SlackOf(piece)));
  }

  bool IsOutsideExactly(const ContactName& name) {
    const auto exact = ExactPointOf(pair_, name);
    if (!exact) return false;
    Vector3d x;
    for (int k = 0; k < 3; ++k) x[k] = RatioToDouble(exact->coordinates[k], exact->denominator);
    const double error = 0x1p-52 * x.cwiseAbs().maxCoeff() + 0x1p-1074;
    ++result_.exact_memberships;
    last_ = Membership(pair_, Translation(x, error, *exact), {Certainty::kExact}, &s_.membership);
    if (last_.verdict == Verdict::kOverlap) return false;
    const Vector3d scaled = x * pair_.scale();
    if (!(scaled.norm() < answer_.upper)) return true;
    Take(scaled, name);
    answer_.at_error = 2.0 * error * pair_.scale();
    answer_.is_exact = true;
    return true;
  }

  // Cuts off a small square round the nearest point, which stays open.
  void CutCrumb(const FacetPiece& piece, const NearestPoint& nearest) {
    ++crumbs_;
    if (piece.cuts >= kMaxCuts) return;  // all of it stays open
    const double half = std::max(kCrumb, 8.0 * SlackOf(piece));
    FacetPiece rest = piece;
    for (int k = 0; k < 4; ++k) {
      if (rest.count >= kMaxPieceCorners - 1) return;
      const double a = k == 0 ? 1.0 : k == 1 ? -1.0 : 0.0, b = k == 2 ? 1.0 : k == 3 ? -1.0 : 0.0;
      FacetPiece in, out;
      Part(rest, {a, b, a * nearest.at[0] + b * nearest.at[1] + half}, kNoWall, &in, &out);
      if (out.count > 0) {
        Measure(FrameOf(out), &out);
        Push(out);
      }
      if (in.count == 0) return;
      rest = in;
    }
  }

  // What helps the next query.
  void Remember() {
    s_.answer = answer_.name;
    s_.pose = pair_.pose();
    s_.prism_names.clear();
    for (int i = s_.prisms.size() - 1; i >= 0 && s_.prism_names.size() < kRememberedPrisms; --i) {
      if (s_.prism_uses[i] > 0) s_.prism_names.push_back(s_.prisms.prism(i).name);
    }
    s_.ball_faces.clear();
    for (auto it = met_balls_.rbegin();
         it != met_balls_.rend() && s_.ball_faces.size() < kRememberedBalls; ++it) {
      s_.ball_faces.push_back(*it);
    }
  }

  const MeshPair& pair_;
  const ContactBody &a_, &b_;
  const MeshDepthOptions& options_;
  DepthScratch& s_;
  MeshDepthResult& result_;
  DepthAnswer answer_;
  MembershipResult last_;
  double radius_ = 0.0;
  double open_ = std::numeric_limits<double>::infinity();
  bool found_ = false;
  bool is_listing_ = false;
  int crumbs_ = 0;
  std::vector<std::pair<int, int>> met_balls_;
};

}  // namespace

DepthAnswer SearchDepth(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                        const MeshDepthOptions& options, DepthScratch* scratch,
                        MeshDepthResult* result) {
  return Search(pair, a, b, options, scratch, result).Run();
}

}  // namespace touchstone::internal
