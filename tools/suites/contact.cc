// SPDX-License-Identifier: MIT
#include "touchstone/tools/suites/contact.h"

#include <cassert>
#include <cmath>

#include "touchstone/tools/suites/arithmetic.h"

namespace touchstone {
namespace {

constexpr int kDraws = 200;

bool IsZero(const Eigen::Vector3d& v) { return v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0; }

// R^T x; exact for an axis rotation.
Eigen::Vector3d RotateBack(const Eigen::Matrix3d& r, const Eigen::Vector3d& x) {
  Eigen::Vector3d y;
  for (int i = 0; i < 3; ++i) y[i] = (r(0, i) * x[0] + r(1, i) * x[1]) + r(2, i) * x[2];
  return y;
}

// Outward, of any length; exact for small integer coordinates.
Eigen::Vector3d RandomFaceNormal(Random& random, const ConvexPolyhedron& body) {
  const auto loop = body.face(random.Integer(0, body.face_count() - 1));
  const Eigen::Vector3d& a = body.vertex(loop[0]);
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const Eigen::Vector3d normal =
        PlainCross(body.vertex(loop[k]) - a, body.vertex(loop[k + 1]) - a);
    if (!IsZero(normal)) return normal;
  }
  return Eigen::Vector3d::UnitX();
}

Eigen::Vector3d RandomEdge(Random& random, const ConvexPolyhedron& body) {
  const auto loop = body.face(random.Integer(0, body.face_count() - 1));
  const int k = random.Integer(0, static_cast<int>(loop.size()) - 1);
  return body.vertex(loop[(k + 1) % loop.size()]) - body.vertex(loop[k]);
}

Eigen::Vector3d DrawDirection(Random& random, const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                              const Eigen::Matrix3d& rotation) {
  const auto normal_p = [&] { return RandomFaceNormal(random, p); };
  const auto normal_q = [&] {
    return Eigen::Vector3d(-PlainRotate(rotation, RandomFaceNormal(random, q)));
  };
  switch (random.Integer(0, 5)) {
    case 0:
      return normal_p();
    case 1:
      return normal_q();
    case 2: {
      const Eigen::Vector3d edge_p = RandomEdge(random, p);
      const Eigen::Vector3d cross =
          PlainCross(edge_p, PlainRotate(rotation, RandomEdge(random, q)));
      return random.OneIn(2) ? cross : Eigen::Vector3d(-cross);
    }
    case 3: {
      const Eigen::Vector3d first = normal_p();
      return first + normal_p();
    }
    case 4:
      return p.vertex(random.Integer(0, p.vertex_count() - 1));
    default: {
      Eigen::Vector3d direction;
      for (int i = 0; i < 3; ++i) direction[i] = random.Integer(-4, 4);
      return direction;
    }
  }
}

// A mixture of up to three vertices of the feature with weights in sixteenths: exact.
Eigen::Vector3d RandomPoint(Random& random, const ConvexPolyhedron& body,
                            const ExtremeFeature& feature) {
  const std::span<const int> vertices(feature.vertices);
  const int first = random.Integer(0, 16);
  const int second = random.Integer(0, 16 - first);
  const std::array<int, 3> weights = {first, second, 16 - first - second};
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (const int weight : weights) {
    const Eigen::Vector3d& vertex = body.vertex(random.Pick(vertices));
    for (int i = 0; i < 3; ++i) point[i] += weight * vertex[i] / 16.0;
  }
  return point;
}

// Offsets 0 to 9 are the touch itself, 10 is one ulp apart and 11 one ulp in; then travels apart
// (positive) or in, relative to the size.
double TravelOfOffset(int offset) {
  static constexpr std::array<double, kContactOffsetCount - 12> kTravels = {
      1e-12, -1e-12, 1e-9, -1e-9, 1e-2, -1e-2, 2.0, -0.5};
  return kTravels[offset - 12];
}

bool IsApart(int offset) { return offset == 10 || (offset >= 12 && TravelOfOffset(offset) > 0.0); }

// Moves a touching translation towards the middle of M, which is inside whatever feature o touches:
// by `travel` along the axis where that is longest and in proportion along the others, or, when
// zero, by one ulp along each.
void MoveIn(Eigen::Vector3d& translation, const Eigen::Vector3d& middle, double travel,
            double size) {
  const Eigen::Vector3d out = translation - middle;
  const double longest = std::fabs(out[LongestAxis(out)]);
  for (int i = 0; i < 3; ++i) {
    if (out[i] == 0.0) continue;
    translation[i] = travel == 0.0 ? StepUlp(translation[i], out[i] < 0.0, size)
                                   : translation[i] - travel * (out[i] / longest);
  }
}

}  // namespace

ExtremeFeature FindExtreme(const ConvexPolyhedron& body, const Eigen::Vector3d& direction) {
  ExtremeFeature feature;
  double best = 0.0;
  for (int v = 0; v < body.vertex_count(); ++v) {
    const double value = PlainDot(direction, body.vertex(v));
    if (feature.vertices.empty() || value > best) {
      best = value;
      feature.vertices.assign(1, v);
    } else if (value == best) {
      feature.vertices.push_back(v);
    }
  }
  const Eigen::Vector3d& a = body.vertex(feature.vertices[0]);
  for (std::size_t k = 1; k < feature.vertices.size(); ++k) {
    const Eigen::Vector3d cross =
        PlainCross(body.vertex(feature.vertices[1]) - a, body.vertex(feature.vertices[k]) - a);
    feature.dimension = std::max(feature.dimension, IsZero(cross) ? 1 : 2);
  }
  return feature;
}

ContactFeatures DrawContact(Random& random, const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                            const Eigen::Matrix3d& rotation, const WantedDimensions& wanted) {
  ContactFeatures contact;
  for (int draw = 0; draw < kDraws; ++draw) {
    contact.normal = DrawDirection(random, p, q, rotation);
    if (IsZero(contact.normal)) contact.normal = Eigen::Vector3d::UnitX();
    contact.p = FindExtreme(p, contact.normal);
    contact.q = FindExtreme(q, RotateBack(rotation, Eigen::Vector3d(-contact.normal)));
    if (wanted(contact.p.dimension, contact.q.dimension)) break;
  }
  return contact;
}

PlacedPair PlaceAtContact(Random& random, const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                          const Eigen::Matrix3d& rotation, const ContactFeatures& contact,
                          int offset) {
  const Eigen::Vector3d a = RandomPoint(random, p, contact.p);
  const Eigen::Vector3d touching = a - PlainRotate(rotation, RandomPoint(random, q, contact.q));
  const double size = std::fmax(PlainMaxCoordinate(p.vertices()), PlainMaxCoordinate(q.vertices()));
  const int axis = LongestAxis(contact.normal);
  const double sense = contact.normal[axis] > 0.0 ? 1.0 : -1.0;

  Eigen::Vector3d translation = touching;
  if (offset == 10) {
    translation[axis] = StepUlp(translation[axis], sense > 0.0, size);
  } else if (IsApart(offset)) {
    translation[axis] += sense * (TravelOfOffset(offset) * size);
  } else if (offset >= 11) {
    const Eigen::Vector3d middle =
        PlainMean(p.vertices()) - PlainRotate(rotation, PlainMean(q.vertices()));
    MoveIn(translation, middle, offset == 11 ? 0.0 : -TravelOfOffset(offset) * size, size);
  }
  const bool moved = translation != touching;
  StatusOr<RelativePose> pose = RelativePose::Make(rotation, translation);
  assert(pose.ok());
  PlacedPair pair{p, q, *pose};
  if (!moved) {
    pair.expected = Verdict::kTouch;
  } else if (sense * (translation[axis] - touching[axis]) > 0.0 && IsApart(offset)) {
    pair.expected = Verdict::kSeparate;
  }
  return pair;
}

}  // namespace touchstone
