// SPDX-License-Identifier: MIT
//
// ODE 0.16 in double precision: dCollide of two convex geoms. Contacts are what it answers; none is
// separate. Its tolerances are constants of the library.
#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <vector>

#include "touchstone/tools/engines/registry.h"

namespace touchstone {
namespace {

#ifndef dDOUBLE
#error "this adapter compares ODE on doubles"
#endif

// ODE asks for the origin within a body: one that does not hold it is moved by an interior point,
// and its coordinates are rounded. A geom keeps pointers to these arrays.
struct Shape : EngineShape {
  explicit Shape(const ConvexPolyhedron& body) {
    if (!HoldsOrigin(body)) centre = body.interior_point(0);
    for (const Eigen::Vector3d& v : body.vertices()) {
      for (int k = 0; k < 3; ++k) points.push_back(v[k] - centre[k]);
    }
    for (int f = 0; f < body.face_count(); ++f) {
      const Eigen::Vector3d normal = body.face_normal(f).normalized();
      double offset = 0.0;
      for (const Eigen::Vector3d& v : body.vertices())
        offset = std::max(offset, normal.dot(v - centre));
      planes.insert(planes.end(), {normal[0], normal[1], normal[2], offset});
      polygons.push_back(static_cast<unsigned>(body.face(f).size()));
      for (const int v : body.face(f)) polygons.push_back(static_cast<unsigned>(v));
    }
  }

  static bool HoldsOrigin(const ConvexPolyhedron& body) {
    for (int f = 0; f < body.face_count(); ++f) {
      if (!(body.face_normal(f).dot(body.vertex(body.face(f)[0])) > 0.0)) return false;
    }
    return true;
  }
  unsigned plane_count() const { return static_cast<unsigned>(planes.size() / 4); }
  unsigned point_count() const { return static_cast<unsigned>(points.size() / 3); }

  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons;
};

class Geom {
 public:
  explicit Geom(const Shape& shape)
      : id_(dCreateConvex(nullptr, shape.planes.data(), shape.plane_count(), shape.points.data(),
                          shape.point_count(), shape.polygons.data())) {}
  ~Geom() { dGeomDestroy(id_); }
  Geom(const Geom&) = delete;
  Geom& operator=(const Geom&) = delete;
  dGeomID id() const { return id_; }

 private:
  dGeomID id_;
};

class Pair : public EnginePair {
 public:
  Pair(const Shape& p, const Shape& q, const RelativePose& pose) : p_(p), q_(q) {
    dGeomSetPosition(p_.id(), p.centre[0], p.centre[1], p.centre[2]);
    dMatrix3 rotation;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) rotation[4 * i + j] = pose.rotation()(i, j);
      rotation[4 * i + 3] = 0.0;
    }
    dGeomSetRotation(q_.id(), rotation);
    const Eigen::Vector3d t = pose.rotation() * q.centre + pose.translation();
    dGeomSetPosition(q_.id(), t[0], t[1], t[2]);
  }

  Verdict Ask(EngineCache*) const override {
    dContactGeom contact;
    return dCollide(p_.id(), q_.id(), 1, &contact, sizeof contact) > 0 ? Verdict::kOverlap
                                                                       : Verdict::kSeparate;
  }

 private:
  Geom p_, q_;
};

class OdeEngine : public Engine {
 public:
  OdeEngine() {
    static const bool kReady = dInitODE2(0) != 0;
    // For the thread that asks: ODE keeps buffers by thread.
    if (kReady) dAllocateODEDataForThread(dAllocateMaskAll);
    // It writes to stderr what it thinks of its input.
    dSetMessageHandler([](int, const char*, va_list) {});
  }
  std::unique_ptr<EngineShape> Prepare(const ConvexPolyhedron& body) const override {
    return std::make_unique<Shape>(body);
  }
  std::unique_ptr<EnginePair> Place(const EngineShape& p, const EngineShape& q,
                                    const RelativePose& pose) const override {
    return std::make_unique<Pair>(static_cast<const Shape&>(p), static_cast<const Shape&>(q), pose);
  }
};

}  // namespace

void DescribeOde(std::vector<EngineDescription>& engines) {
  EngineDescription engine;
  engine.name = "ode";
  engine.summary = "ODE 0.16, convex against convex, double precision";
  engine.touch = TouchConvention::kEither;
  engine.quadratic = true;
  engine.make = [](double) -> std::unique_ptr<Engine> { return std::make_unique<OdeEngine>(); };
  engines.push_back(engine);
}

}  // namespace touchstone
