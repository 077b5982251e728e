// SPDX-License-Identifier: GPL-3.0-or-later
//
// Check 3: the exit face is a facet of M, crossed by the ray, of the class named.
#include <algorithm>

#include "touchstone/exact/judge/checks.h"
#include "touchstone/exact/support.h"

namespace touchstone::exact {

int DimensionOf(FeatureKind kind) {
  return kind == FeatureKind::kVertex ? 0 : kind == FeatureKind::kEdge ? 1 : 2;
}

std::vector<int> VerticesOf(const ExactBodyData& body, const Feature& feature) {
  if (feature.kind == FeatureKind::kVertex) return {feature.index};
  if (feature.kind == FeatureKind::kEdge) {
    const ExactEdge& edge = body.topology().edges[feature.index];
    return {edge.tail, edge.head};
  }
  const std::span<const int> loop = body.face(feature.index);
  return {loop.begin(), loop.end()};
}

bool Includes(const std::vector<int>& sorted, const std::vector<int>& some) {
  return std::all_of(some.begin(), some.end(),
                     [&](int i) { return std::binary_search(sorted.begin(), sorted.end(), i); });
}

namespace {

struct Dimensions {
  int p, q;
};

Dimensions DimensionsOf(FaceClass face_class) {
  switch (face_class) {
    case FaceClass::kFaceVertex:
      return {2, 0};
    case FaceClass::kVertexFace:
      return {0, 2};
    case FaceClass::kEdgeEdge:
      return {1, 1};
    case FaceClass::kFaceEdge:
      return {2, 1};
    case FaceClass::kEdgeFace:
      return {1, 2};
    case FaceClass::kFaceFace:
      return {2, 2};
  }
  return {-1, -1};
}

// The edge vectors of a feature's outline.
std::vector<IntegerVector> Sides(const ExactBodyData& body, const std::vector<int>& vertices) {
  std::vector<IntegerVector> sides;
  if (vertices.size() < 2) return sides;
  const std::size_t count = vertices.size() == 2 ? 1 : vertices.size();
  for (std::size_t k = 0; k < count; ++k) {
    sides.push_back(body.vertices[vertices[(k + 1) % vertices.size()]] -
                    body.vertices[vertices[k]]);
  }
  return sides;
}

// Whether the exit point lies in {a - b : a in P's feature, b in Q's}, both in the supporting plane
// with normal n: it does iff no line along a side of either has the whole part on its one side and
// the point strictly on the other. All in coordinates less c, scaled by the ratio's numerator so
// that the exit point, v * denominator / numerator, is whole.
bool PartContainsExitPoint(const PlacedPair& pair, const IntegerVector& n, const Ratio& ratio,
                           const std::vector<int>& vertices_p, const std::vector<int>& vertices_q) {
  const IntegerVector exit = ratio.denominator * pair.v();
  std::vector<IntegerVector> sides = Sides(pair.p(), vertices_p);
  for (const IntegerVector& side : Sides(pair.q(), vertices_q))
    sides.push_back(pair.VectorFromQ(side));
  std::vector<IntegerVector> sums;
  for (const int a : vertices_p) {
    for (const int b : vertices_q) sums.push_back(pair.FromC({a, b}));
  }
  for (const IntegerVector& side : sides) {
    const IntegerVector across = Cross(side, n);
    const Integer at_exit = Dot(across, exit);
    Integer most = Dot(across, sums[0]), least = most;
    for (std::size_t i = 1; i < sums.size(); ++i) {
      const Integer value = Dot(across, sums[i]);
      if (value > most) most = value;
      if (value < least) least = value;
    }
    if (at_exit > most * ratio.numerator || at_exit < least * ratio.numerator) return false;
  }
  return true;
}

void CheckClass(const JudgeContext& context, const SupportingFeatures& supporting) {
  const ExitFace& face = *context.result.face;
  const std::string name(ToString(face.face_class));
  const Dimensions claimed = DimensionsOf(face.face_class);
  if (DimensionOf(face.feature_p.kind) != claimed.p ||
      DimensionOf(face.feature_q.kind) != claimed.q) {
    return context.Add(FindingKind::kWrongClass, "the features named are not those of " + name);
  }
  const std::optional<FaceClass> exact = ClassOf(context.pair, supporting);
  const std::vector<int> vertices_p = VerticesOf(context.pair.p(), face.feature_p);
  const std::vector<int> vertices_q = VerticesOf(context.pair.q(), face.feature_q);
  if (!Includes(supporting.p, vertices_p) || !Includes(supporting.q, vertices_q)) {
    return context.Add(FindingKind::kWrongClass, "a feature named does not lie in the plane");
  }
  if (exact == face.face_class) return;
  // A finer claim.
  const std::string is = exact.has_value() ? std::string(ToString(*exact)) : "no facet";
  const Dimensions truth = exact.has_value() ? DimensionsOf(*exact) : Dimensions{-1, -1};
  if (claimed.p > truth.p || claimed.q > truth.q) {
    return context.Add(FindingKind::kWrongClass, "says " + name + ", is " + is);
  }
  if (face.face_class == FaceClass::kEdgeEdge) {
    const std::vector<IntegerVector> p = Sides(context.pair.p(), vertices_p),
                                     q = Sides(context.pair.q(), vertices_q);
    if (IsZero(Cross(p[0], context.pair.VectorFromQ(q[0])))) {
      return context.Add(FindingKind::kWrongClass, "the edges named are parallel; is " + is);
    }
  }
  // The paper knows three classes only, and its F_fv holds a face of P with any one supporting
  // vertex.
  if (context.published()) return;
  if (!PartContainsExitPoint(context.pair, context.face->normal, context.face->ratio, vertices_p,
                             vertices_q)) {
    context.Add(FindingKind::kWrongClass,
                "says " + name + ", is " + is + ", and the part named misses the exit point");
  }
}

}  // namespace

void CheckFace(JudgeContext* context) {
  if (!context->result.face.has_value()) return;
  const ExitFace& face = *context->result.face;
  const NamedTriangle& triangle = context->Triangle(face.triangle);
  if (IsZero(triangle.normal)) {
    return context->Add(FindingKind::kNotAFace, "the three points are collinear");
  }
  if (sgn(triangle.ratio.denominator) <= 0) {
    return context->Add(FindingKind::kNotAFace, "the three points run clockwise seen from outside");
  }
  const SupportingFeatures& supporting = context->SupportingTriangle();
  for (const VertexPair& point : face.triangle) {
    if (!std::binary_search(supporting.p.begin(), supporting.p.end(), point.p) ||
        !std::binary_search(supporting.q.begin(), supporting.q.end(), point.q)) {
      return context->Add(FindingKind::kNotAFace, "the plane does not support M");
    }
  }
  NamedFace named{triangle.normal, triangle.ratio};
  named.crossed =
      sgn(named.ratio.numerator) > 0 &&
      std::all_of(triangle.sides.begin(), triangle.sides.end(), [](int side) { return side >= 0; });
  context->face = named;
  if (!named.crossed) {
    // As printed, the paper's search may stop at any face with d > 0.
    const bool may_be_any = context->published() && context->options.early_exit;
    if (!may_be_any && Compare(named.ratio, context->ExitRatio()) != 0) {
      // The part that holds the exit point is another facet's: nothing more to say of this one.
      return context->Add(FindingKind::kNotOptimal, "a facet of M that the ray does not leave by");
    }
    // The published search names a facet by three of its vertices, not by the triangle crossed.
    if (!context->published()) {
      context->Add(FindingKind::kNotAFace, "the ray misses the triangle");
    }
  }
  CheckClass(*context, supporting);
}

}  // namespace touchstone::exact
