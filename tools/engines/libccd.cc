// SPDX-License-Identifier: MIT
//
// libccd 2.1 in double precision: GJK and MPR, each with the support that its users write (a scan
// of all vertices) and with ours plugged in.
#include <ccd/ccd.h>
#include <ccd/vec3.h>

#include <limits>

#include "touchstone/core/convex/support.h"
#include "touchstone/tools/engines/own_copy.h"
#include "touchstone/tools/engines/registry.h"
#include "touchstone/tools/engines/scan_support.h"

namespace touchstone {
namespace {

#ifndef CCD_DOUBLE
#error "this adapter compares libccd on doubles; the installed one is built for float"
#endif

// Support pairs after which a query is given up and counted as undecided. Both algorithms are known
// to run for ever on parallel faces; where they end, they end within a hundred.
constexpr int kMaxSupportPairs = 2000;

enum class Algorithm { kGjk, kMpr };

struct ScannedBody {
  explicit ScannedBody(const ConvexPolyhedron& b) : body(OwnCopy(b)), scan(b) {}
  int Find(const Eigen::Vector3d& direction) const { return scan.Find(direction); }
  ConvexPolyhedron body;
  ScanSupport scan;
};

struct ClimbedBody {
  explicit ClimbedBody(const ConvexPolyhedron& b) : body(OwnCopy(b)) {}
  int Find(const Eigen::Vector3d& direction) const { return SupportVertex(body, direction); }
  ConvexPolyhedron body;
};

template <class Body>
struct Shape : EngineShape {
  explicit Shape(const ConvexPolyhedron& b) : body(b) {
    center.setZero();
    for (const Eigen::Vector3d& v : b.vertices()) center += v;
    center /= b.vertex_count();
  }
  Body body;
  Eigen::Vector3d center;
};

// What libccd passes to the callbacks: one body, for one query.
template <class Body>
struct Object {
  const Shape<Body>* shape;
  const RelativePose* pose;  // null: the body is in the frame of the query
  int support_calls = 0;

  bool exhausted() const { return support_calls > kMaxSupportPairs; }
};

ccd_vec3_t ToCcd(const Eigen::Vector3d& v) { return {{v[0], v[1], v[2]}}; }

template <class Body>
void Support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  // libccd hands back as const what it was given; the counter is ours.
  auto& self = *static_cast<Object<Body>*>(const_cast<void*>(object));
  if (++self.support_calls > kMaxSupportPairs) {
    // Not a number ends every loop of libccd: each goes on only while a comparison holds.
    const double nan = std::numeric_limits<double>::quiet_NaN();
    *point = {{nan, nan, nan}};
    return;
  }
  const Eigen::Vector3d n(direction->v[0], direction->v[1], direction->v[2]);
  const Body& body = self.shape->body;
  if (self.pose == nullptr) {
    *point = ToCcd(body.body.vertex(body.Find(n)));
    return;
  }
  const Eigen::Matrix3d& r = self.pose->rotation();
  const int vertex = body.Find(r.transpose() * n);
  *point = ToCcd(r * body.body.vertex(vertex) + self.pose->translation());
}

template <class Body>
void Center(const void* object, ccd_vec3_t* point) {
  const auto& self = *static_cast<const Object<Body>*>(object);
  const Eigen::Vector3d& c = self.shape->center;
  *point = ToCcd(self.pose == nullptr
                     ? c
                     : Eigen::Vector3d(self.pose->rotation() * c + self.pose->translation()));
}

template <class Body, Algorithm kAlgorithm>
class Pair : public EnginePair {
 public:
  Pair(const Shape<Body>& p, const Shape<Body>& q, const RelativePose& pose, const ccd_t& ccd)
      : p_(p), q_(q), pose_(pose), ccd_(ccd) {}

  Verdict Ask(EngineCache* /*cache*/) const override {
    Object<Body> p{&p_, nullptr};
    Object<Body> q{&q_, &pose_};
    const int meets = kAlgorithm == Algorithm::kGjk ? ccdGJKIntersect(&p, &q, &ccd_)
                                                    : ccdMPRIntersect(&p, &q, &ccd_);
    if (p.exhausted() || q.exhausted()) return Verdict::kUndecided;
    return meets != 0 ? Verdict::kOverlap : Verdict::kSeparate;
  }

  std::optional<EngineValue> Measure(Quantity quantity) const override {
    if (quantity != Quantity::kDepth) return std::nullopt;
    Object<Body> p{&p_, nullptr};
    Object<Body> q{&q_, &pose_};
    ccd_real_t depth = 0.0;
    ccd_vec3_t direction, position;
    const int status = kAlgorithm == Algorithm::kGjk
                           ? ccdGJKPenetration(&p, &q, &ccd_, &depth, &direction, &position)
                           : ccdMPRPenetration(&p, &q, &ccd_, &depth, &direction, &position);
    if (status != 0 || p.exhausted() || q.exhausted()) return std::nullopt;
    return EngineValue{depth};
  }

 private:
  const Shape<Body>& p_;
  const Shape<Body>& q_;
  RelativePose pose_;
  const ccd_t& ccd_;
};

template <class Body, Algorithm kAlgorithm>
class LibccdEngine : public Engine {
 public:
  explicit LibccdEngine(double tolerance) {
    CCD_INIT(&ccd_);
    ccd_.support1 = Support<Body>;
    ccd_.support2 = Support<Body>;
    ccd_.center1 = Center<Body>;
    ccd_.center2 = Center<Body>;
    // Counted by Support, so that running out is told from an answer.
    ccd_.max_iterations = 2 * kMaxSupportPairs;
    ccd_.mpr_tolerance = tolerance;
    ccd_.epa_tolerance = tolerance;
    ccd_.dist_tolerance = tolerance;
  }

  std::unique_ptr<EngineShape> Prepare(const ConvexPolyhedron& body) const override {
    return std::make_unique<Shape<Body>>(body);
  }
  std::unique_ptr<EnginePair> Place(const EngineShape& p, const EngineShape& q,
                                    const RelativePose& pose) const override {
    return std::make_unique<Pair<Body, kAlgorithm>>(static_cast<const Shape<Body>&>(p),
                                                    static_cast<const Shape<Body>&>(q), pose, ccd_);
  }

 private:
  ccd_t ccd_;
};

template <class Body, Algorithm kAlgorithm>
EngineDescription Describe(const char* name, const char* summary) {
  EngineDescription engine;
  engine.name = name;
  engine.summary = summary;
  engine.touch = TouchConvention::kEither;
  engine.make = [](double tolerance) -> std::unique_ptr<Engine> {
    return std::make_unique<LibccdEngine<Body, kAlgorithm>>(tolerance);
  };
  // The verdict of GJK uses no tolerance but the library's constant; only its depth does.
  engine.tolerances = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14};
  engine.default_tolerance = 1e-4;
  engine.best_tolerance = 1e-12;
  return engine;
}

}  // namespace

void DescribeLibccd(std::vector<EngineDescription>& engines) {
  engines.push_back(
      Describe<ScannedBody, Algorithm::kMpr>("libccd-mpr", "libccd MPR, vector scan support"));
  engines.push_back(
      Describe<ClimbedBody, Algorithm::kMpr>("libccd-mpr+support", "libccd MPR with our support"));
  engines.push_back(
      Describe<ScannedBody, Algorithm::kGjk>("libccd-gjk", "libccd GJK, vector scan support"));
  engines.push_back(
      Describe<ClimbedBody, Algorithm::kGjk>("libccd-gjk+support", "libccd GJK with our support"));
}

}  // namespace touchstone
