// SPDX-License-Identifier: MIT
#include "touchstone/tools/engines/enhanced_gjk.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "touchstone/tools/engines/own_copy.h"
#include "touchstone/tools/engines/registry.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr int kMaxRounds = 500;

struct MVertex {
  VertexPair pair;
  Vector3d point;
};

struct Simplex {
  std::array<MVertex, 4> vertices;
  int size = 0;

  void Keep(std::initializer_list<int> which) {
    const std::array<MVertex, 4> old = vertices;
    size = 0;
    for (const int i : which) vertices[size++] = old[i];
  }
};

// The vertex that no neighbour beats, climbing over the body's own edges.
int Climb(const ConvexPolyhedron& body, const Vector3d& direction, int start) {
  int best = start;
  double best_height = direction.dot(body.vertex(best));
  for (;;) {
    const int from = best;
    for (const int neighbor : body.vertex_neighbors(from)) {
      const double height = direction.dot(body.vertex(neighbor));
      if (height > best_height) {
        best = neighbor;
        best_height = height;
      }
    }
    if (best == from) return best;
  }
}

// Each reduces the simplex to the smallest face that holds its point nearest to the origin, and
// returns that point.

Vector3d NearestOnSegment(Simplex& s) {
  const Vector3d a = s.vertices[0].point;
  const Vector3d ab = s.vertices[1].point - a;
  const double t = -a.dot(ab);
  const double length = ab.squaredNorm();
  if (t <= 0.0) return s.Keep({0}), a;
  if (t >= length) return s.Keep({1}), s.vertices[0].point;
  return a + (t / length) * ab;
}

Vector3d NearestOnTriangle(Simplex& s) {
  const Vector3d a = s.vertices[0].point, b = s.vertices[1].point, c = s.vertices[2].point;
  const Vector3d ab = b - a, ac = c - a;
  const double d1 = -ab.dot(a), d2 = -ac.dot(a);
  if (d1 <= 0.0 && d2 <= 0.0) return s.Keep({0}), a;
  const double d3 = -ab.dot(b), d4 = -ac.dot(b);
  if (d3 >= 0.0 && d4 <= d3) return s.Keep({1}), b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return s.Keep({0, 1}), a + (d1 / (d1 - d3)) * ab;
  const double d5 = -ab.dot(c), d6 = -ac.dot(c);
  if (d6 >= 0.0 && d5 <= d6) return s.Keep({2}), c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return s.Keep({0, 2}), a + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return s.Keep({1, 2}), b + t * (c - b);
  }
  // Inside: the foot on the plane, which is more accurate than the weighted sum.
  const Vector3d normal = ab.cross(ac);
  return (normal.dot(a) / normal.squaredNorm()) * normal;
}

// Zero when the origin is inside.
Vector3d NearestOnTetrahedron(Simplex& s) {
  static constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
  const Simplex whole = s;
  bool inside = true;
  double best = std::numeric_limits<double>::infinity();
  Vector3d nearest = Vector3d::Zero();
  for (const auto& face : kFaces) {
    const Vector3d& a = whole.vertices[face[0]].point;
    const Vector3d normal =
        (whole.vertices[face[1]].point - a).cross(whole.vertices[face[2]].point - a);
    const double opposite = normal.dot(whole.vertices[face[3]].point - a);
    const double origin = -normal.dot(a);
    if (opposite != 0.0 && (origin > 0.0) == (opposite > 0.0) && origin != 0.0) continue;
    inside = false;
    Simplex triangle = whole;
    triangle.Keep({face[0], face[1], face[2]});
    const Vector3d point = NearestOnTriangle(triangle);
    if (point.squaredNorm() < best) {
      best = point.squaredNorm();
      nearest = point;
      s = triangle;
    }
  }
  return inside ? Vector3d::Zero() : nearest;
}

Vector3d Nearest(Simplex& s) {
  switch (s.size) {
    case 1:
      return s.vertices[0].point;
    case 2:
      return NearestOnSegment(s);
    case 3:
      return NearestOnTriangle(s);
    default:
      return NearestOnTetrahedron(s);
  }
}

class GjkSearch {
 public:
  GjkSearch(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose,
            const GjkOptions& options)
      : p_(p), q_(q), pose_(pose), options_(options) {}

  GjkResult Run(GjkSimplex* memory) {
    Begin(memory);
    const GjkResult result = Loop();
    if (memory != nullptr) {
      memory->size = simplex_.size;
      for (int i = 0; i < simplex_.size; ++i) memory->pairs[i] = simplex_.vertices[i].pair;
    }
    return result;
  }

 private:
  MVertex At(const VertexPair& pair) const {
    return {pair, p_.vertex(pair.p) - (pose_.rotation() * q_.vertex(pair.q) + pose_.translation())};
  }

  // The vertex of M furthest against `v`.
  MVertex SupportAgainst(const Vector3d& v) {
    last_.p = Climb(p_, -v, last_.p);
    last_.q = Climb(q_, pose_.rotation().transpose() * v, last_.q);
    return At(last_);
  }

  void Begin(const GjkSimplex* memory) {
    if (memory == nullptr || memory->size == 0) {
      last_ = {0, 0};
      simplex_.vertices[0] = At(last_);
      simplex_.size = 1;
    } else {
      for (int i = 0; i < memory->size; ++i) simplex_.vertices[i] = At(memory->pairs[i]);
      simplex_.size = memory->size;
      last_ = memory->pairs[0];
    }
  }

  bool Holds(const VertexPair& pair) const {
    return std::any_of(simplex_.vertices.begin(), simplex_.vertices.begin() + simplex_.size,
                       [&](const MVertex& v) { return v.pair == pair; });
  }

  double Extent() const {
    double extent = 0.0;
    for (int i = 0; i < simplex_.size; ++i)
      extent = std::max(extent, simplex_.vertices[i].point.squaredNorm());
    return std::sqrt(extent);
  }

  GjkResult Loop() {
    double previous = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kMaxRounds; ++round) {
      const Vector3d v = Nearest(simplex_);
      const double distance = v.norm();
      const double negligible = options_.tolerance * Extent();
      if (simplex_.size == 4 || distance <= negligible) return {Verdict::kOverlap, 0.0};
      const MVertex w = SupportAgainst(v);
      const double lower = v.dot(w.point) / distance;
      if (lower > 0.0 && !options_.want_distance) return {Verdict::kSeparate, distance};
      // Nothing of M is nearer than `lower`: converged, or rounding lets it go no further.
      if (distance - lower <= negligible || Holds(w.pair) || distance >= previous) {
        return {lower > negligible ? Verdict::kSeparate : Verdict::kOverlap, distance};
      }
      previous = distance;
      simplex_.vertices[simplex_.size++] = w;
    }
    return {Verdict::kUndecided, 0.0};
  }

  const ConvexPolyhedron& p_;
  const ConvexPolyhedron& q_;
  const RelativePose& pose_;
  const GjkOptions& options_;
  Simplex simplex_;
  VertexPair last_;
};

struct Shape : EngineShape {
  explicit Shape(const ConvexPolyhedron& b) : body(OwnCopy(b)) {}
  ConvexPolyhedron body;
};

struct Cache : EngineCache {
  GjkSimplex simplex;
};

class Pair : public EnginePair {
 public:
  Pair(const Shape& p, const Shape& q, const RelativePose& pose, const GjkOptions& options)
      : p_(p), q_(q), pose_(pose), options_(options) {}

  Verdict Ask(EngineCache* cache) const override {
    GjkSimplex* simplex = cache == nullptr ? nullptr : &static_cast<Cache*>(cache)->simplex;
    return EnhancedGjk(p_.body, q_.body, pose_, options_, simplex).verdict;
  }

  std::optional<EngineValue> Measure(Quantity quantity) const override {
    if (quantity != Quantity::kDistance) return std::nullopt;
    GjkOptions options = options_;
    options.want_distance = true;
    const GjkResult result = EnhancedGjk(p_.body, q_.body, pose_, options);
    if (result.verdict != Verdict::kSeparate) return std::nullopt;
    return EngineValue{result.distance};
  }

 private:
  const Shape& p_;
  const Shape& q_;
  RelativePose pose_;
  const GjkOptions& options_;
};

class EnhancedGjkEngine : public Engine {
 public:
  explicit EnhancedGjkEngine(double tolerance) { options_.tolerance = tolerance; }

  std::unique_ptr<EngineShape> Prepare(const ConvexPolyhedron& body) const override {
    return std::make_unique<Shape>(body);
  }
  std::unique_ptr<EnginePair> Place(const EngineShape& p, const EngineShape& q,
                                    const RelativePose& pose) const override {
    return std::make_unique<Pair>(static_cast<const Shape&>(p), static_cast<const Shape&>(q), pose,
                                  options_);
  }
  std::unique_ptr<EngineCache> MakeCache() const override { return std::make_unique<Cache>(); }

 private:
  GjkOptions options_;
};

}  // namespace

GjkResult EnhancedGjk(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                      const RelativePose& pose, const GjkOptions& options, GjkSimplex* simplex) {
  return GjkSearch(p, q, pose, options).Run(simplex);
}

void DescribeEnhancedGjk(std::vector<EngineDescription>& engines) {
  EngineDescription engine;
  engine.name = "enhanced-gjk";
  engine.summary = "GJK after Cameron 1997, the paper's comparator, written here";
  engine.touch = TouchConvention::kEither;
  engine.tolerances = {1e-3, 1e-6, 1e-9, 1e-12, 1e-15};
  engine.default_tolerance = 1e-12;
  engine.best_tolerance = 1e-15;
  engine.make = [](double tolerance) -> std::unique_ptr<Engine> {
    return std::make_unique<EnhancedGjkEngine>(tolerance);
  };
  engines.push_back(engine);
}

}  // namespace touchstone
