// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/support.h"

#include <Eigen/Geometry>
#include <cmath>

namespace touchstone::exact {
namespace {

// Vertices that may be extreme. With u = 2^-53, components of the direction are off by 2u of
// themselves, the sum of three products by 3u: 5u sum |n_i x_i| <= 5u |n|_1 X a value, hence 10u
// for a difference; four times that allows for the other rounding modes and for the bound's own
// rounding.
void Candidates(const ExactBodyData& body, const IntegerVector& n, std::vector<int>* candidates) {
  thread_local std::vector<double> values;
  const Eigen::Vector3d d = ToDirection(n);
  const int count = body.vertex_count;
  values.resize(count);
  const double *x = body.x.data(), *y = body.y.data(), *z = body.z.data();
  double* value = values.data();
  for (int i = 0; i < count; ++i) value[i] = d.x() * x[i] + d.y() * y[i] + d.z() * z[i];
  double largest = value[0];
  for (int i = 1; i < count; ++i) largest = value[i] > largest ? value[i] : largest;
  const double error = 0x1p-47 * (d.cwiseAbs().sum() * body.max_coordinate);
  candidates->clear();
  for (int i = 0; i < count; ++i) {
    if (value[i] >= largest - error) candidates->push_back(i);
  }
}

// Edges of P and of Q, each in its own frame. Doubles first: components of both are off by 2u of
// themselves and at most 1, entries of the rotation by 4u and below 2, so that components of the
// turned edge are below 6 and off by 9u 6; of the cross product by 2 (54 + 12 + 6)u + 12u < 2^-45.
bool AreParallel(const PlacedPair& pair, const IntegerVector& edge_p, const IntegerVector& edge_q) {
  const Eigen::Vector3d turned = pair.rotation() * ToDirection(edge_q);
  if (ToDirection(edge_p).cross(turned).cwiseAbs().maxCoeff() > 0x1p-44) return false;
  return IsZero(Cross(edge_p, pair.VectorFromQ(edge_q)));
}

}  // namespace

void ExtremeVertices(const ExactBodyData& body, const IntegerVector& n, std::vector<int>* extreme) {
  Candidates(body, n, extreme);
  if (extreme->size() <= 1) return;
  Integer best = Dot(n, body.vertices[extreme->front()]), value;
  std::size_t kept = 1;
  for (std::size_t i = 1; i < extreme->size(); ++i) {
    const int candidate = (*extreme)[i];
    value = Dot(n, body.vertices[candidate]);
    const int sign = cmp(value, best);
    if (sign < 0) continue;
    if (sign > 0) {
      kept = 0;
      swap(best, value);
    }
    (*extreme)[kept++] = candidate;
  }
  extreme->resize(kept);
}

int ExtremeVertex(const ExactBodyData& body, const IntegerVector& n) {
  thread_local std::vector<int> extreme;
  ExtremeVertices(body, n, &extreme);
  return extreme.front();
}

SupportingFeatures Supporting(const PlacedPair& pair, const IntegerVector& n) {
  SupportingFeatures result;
  ExtremeVertices(pair.p(), n, &result.p);
  ExtremeVertices(pair.q(), -pair.ToQ(n), &result.q);
  return result;
}

VertexPair SupportingPair(const PlacedPair& pair, const IntegerVector& n) {
  return {ExtremeVertex(pair.p(), n), ExtremeVertex(pair.q(), -pair.ToQ(n))};
}

int Dimension(const ExactBodyData& body, const std::vector<int>& vertices) {
  if (vertices.size() <= 1) return 0;
  const IntegerVector& a = body.vertices[vertices[0]];
  const IntegerVector ab = body.vertices[vertices[1]] - a;
  for (std::size_t i = 2; i < vertices.size(); ++i) {
    if (!IsZero(Cross(ab, body.vertices[vertices[i]] - a))) return 2;
  }
  return 1;
}

std::optional<FaceClass> ClassOf(const PlacedPair& pair, const SupportingFeatures& features) {
  const int dimension_p = Dimension(pair.p(), features.p);
  const int dimension_q = Dimension(pair.q(), features.q);
  if (dimension_p == 2) {
    return dimension_q == 0   ? FaceClass::kFaceVertex
           : dimension_q == 1 ? FaceClass::kFaceEdge
                              : FaceClass::kFaceFace;
  }
  if (dimension_q == 2) return dimension_p == 0 ? FaceClass::kVertexFace : FaceClass::kEdgeFace;
  if (dimension_p == 0 || dimension_q == 0) return std::nullopt;
  const IntegerVector edge_p = pair.p().vertices[features.p[1]] - pair.p().vertices[features.p[0]];
  const IntegerVector edge_q = pair.q().vertices[features.q[1]] - pair.q().vertices[features.q[0]];
  if (AreParallel(pair, edge_p, edge_q)) return std::nullopt;
  return FaceClass::kEdgeEdge;
}

Ratio RatioOf(const PlacedPair& pair, const IntegerVector& n, const VertexPair& supporting) {
  return {Dot(n, pair.v()), Dot(n, pair.FromC(supporting))};
}

Ratio RatioOf(const PlacedPair& pair, const IntegerVector& n) {
  return RatioOf(pair, n, SupportingPair(pair, n));
}

}  // namespace touchstone::exact
