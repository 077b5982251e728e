// SPDX-License-Identifier: MIT
//
// Cutting buried parts off pieces of facets.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "touchstone/core/cpd/depth_searcher_internal.h"

namespace touchstone::internal {
namespace {

constexpr double kCrumb = 0x1p-34;    // half the side of what is left open where nothing decides
constexpr double kDeepInBall = 1e-3;  // then a ball buries more than a prism

// Where a plane of a prism crosses the plane of a piece, and how far the piece goes beyond.
struct CutLine {
  Line2 line;
  int plane;
  double beyond;
};

// The lines that part the piece, the one that it goes furthest beyond first: what lies there, far
// from the prism, stays one part (a seventh fewer pieces on the paper's scenes than by number).
int LinesAcross(const FacetPiece& piece, const FacetFrame& frame, const Prism& prism, double slack,
                CutLine lines[kPrismPlanes]) {
  int count = 0;
  for (int k = 0; k < kPrismPlanes; ++k) {
    const Eigen::Vector3d& normal = prism.normals[k];
    CutLine cut = {{normal.dot(frame.u), normal.dot(frame.v),
                    prism.offsets[k] - frame.height * normal.dot(frame.normal) - slack},
                   k,
                   0.0};
    for (int i = 0; i < piece.count; ++i) {
      cut.beyond = std::max(cut.beyond, cut.line.Beyond(piece.at[i]));
    }
    if (!(cut.beyond > 0.0)) continue;
    cut.beyond /= std::sqrt(cut.line.a * cut.line.a + cut.line.b * cut.line.b);
    int at = count++;
    for (; at > 0 && lines[at - 1].beyond < cut.beyond; --at) lines[at] = lines[at - 1];
    lines[at] = cut;
  }
  return count;
}

}  // namespace

using Eigen::Vector2d;
using Eigen::Vector3d;

bool DepthSearcher::CutByKnown(const FacetPiece& piece, const Vector3d& x) {
  const double least = 4.0 * SlackOf(piece);
  const std::optional<BurialBall> ball = s_.balls.Find(x, least);
  const bool is_deep = ball && ball->radius - (x - ball->centre).norm() > kDeepInBall;
  if (is_deep && CutByBall(piece, *ball)) return true;
  const PrismList::Deepest known = s_.prisms.FindDeepest(x);
  if (known.number >= 0) {
    const int deep = known.margin > least ? known.number : WalkFrom(known.number, x, least);
    if (deep >= 0 && CutByPrism(piece, deep)) return true;
  }
  return ball && !is_deep && CutByBall(piece, *ball);
}

bool DepthSearcher::CutByPrism(const FacetPiece& piece, int number) {
  const FacetFrame& frame = FrameOf(piece);
  CutLine lines[kPrismPlanes];
  const int line_count = LinesAcross(piece, frame, s_.prisms.prism(number), SlackOf(piece), lines);
  FacetPiece within[2], parts[kPrismPlanes];
  const FacetPiece* rest = &piece;
  int count = 0;
  for (const CutLine& cut : std::span(lines).first(line_count)) {
    if (IsWithin(*rest, cut.line)) continue;
    if (rest->count >= kMaxPieceCorners) {
      Halve(piece);
      return true;
    }
    FacetPiece& in = within[rest == &within[0] ? 1 : 0];
    Part(*rest, cut.line, kPrismPlanes * number + cut.plane, &in, &parts[count]);
    if (in.count == 0) return false;
    if (parts[count].count > 0) ++count;
    rest = &in;
  }
  ++s_.prism_uses[number];
  for (int k = 0; k < count; ++k) {
    Measure(frame, &parts[k]);
    Push(parts[k]);
  }
  return true;
}

bool DepthSearcher::CutByBall(const FacetPiece& piece, const BurialBall& ball) {
  const FacetFrame& frame = FrameOf(piece);
  const double radius = ball.radius - 2.0 * SlackOf(piece);
  const double height = frame.normal.dot(ball.centre) - frame.height;
  const double squared = radius * radius - height * height;
  if (!(radius > 0.0) || !(squared > 0.0)) return false;
  const Vector2d centre(frame.u.dot(ball.centre), frame.v.dot(ball.centre));
  Vector2d middle = Vector2d::Zero();
  for (int i = 0; i < piece.count; ++i) middle += piece.at[i] / piece.count;
  const Vector2d across = middle - piece.nearest.at;
  const double length = across.norm();
  if (!(length > 0.0)) return (piece.nearest.at - centre).squaredNorm() < squared;
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
  const double gain = least - along.dot(piece.nearest.at);
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

void DepthSearcher::Halve(const FacetPiece& piece) {
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

void DepthSearcher::LeaveOpen(const FacetPiece& piece, double distance) {
  open_ = std::min(open_, std::max(0.0, distance - SlackOf(piece)));
}

void DepthSearcher::CutCrumb(const FacetPiece& piece) {
  ++crumbs_;
  if (piece.cuts >= kMaxCuts) return;  // all of it stays open
  const double half = std::max(kCrumb, 8.0 * SlackOf(piece));
  FacetPiece rest = piece;
  for (int k = 0; k < 4; ++k) {
    if (rest.count >= kMaxPieceCorners - 1) return;
    const double a = k == 0 ? 1.0 : k == 1 ? -1.0 : 0.0, b = k == 2 ? 1.0 : k == 3 ? -1.0 : 0.0;
    FacetPiece in, out;
    Part(rest, {a, b, a * piece.nearest.at[0] + b * piece.nearest.at[1] + half}, kNoWall, &in,
         &out);
    if (out.count > 0) {
      Measure(FrameOf(out), &out);
      Push(out);
    }
    if (in.count == 0) return;
    rest = in;
  }
}

}  // namespace touchstone::internal
