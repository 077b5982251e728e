// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/published_twin.h"

#include <algorithm>
#include <cmath>

#include "touchstone/exact/decide.h"
#include "touchstone/exact/exit_values.h"
#include "touchstone/exact/phase_maxima.h"
#include "touchstone/exact/support.h"

namespace touchstone::exact {
namespace {

struct TwinFace {
  FaceClass face_class;
  Feature feature_p, feature_q;
  IntegerVector normal;  // outward
  Ratio ratio;           // 1 + d |c|
};

// a.s / |a| against b.s / |b|, by signs and squares. Returns whether a's is larger.
bool FacesMore(const IntegerVector& a, const IntegerVector& b, const IntegerVector& s) {
  const Integer as = Dot(a, s), bs = Dot(b, s);
  const int sign_a = sgn(as), sign_b = sgn(bs);
  if (sign_a != sign_b) return sign_a > sign_b;
  const int squares = cmp(as * as * Dot(b, b), bs * bs * Dot(a, a));
  return sign_a > 0 ? squares > 0 : squares < 0;
}

class Twin {
 public:
  Twin(const PlacedPair& pair, const TwinOptions& options)
      : pair_(pair), options_(options), p_(pair.p()), q_(pair.q()) {}

  // CD-DUALITY.
  TwinResult Run() {
    const TwinFace fv = SearchFaceVertex();
    TwinFace best = fv;
    if (!Exits(fv)) {
      const TwinFace vf = SearchVertexFace(fv.feature_q.index);
      if (Compare(vf.ratio, fv.ratio) > 0) best = vf;
      if (!Exits(best)) best = SearchEdgeEdge(std::move(best));
    }
    Finish(best);
    return std::move(out_);
  }

 private:
  TwinFace FaceVertex(int f) const {
    TwinFace face{
        FaceClass::kFaceVertex, {FeatureKind::kFace, f}, {}, FaceVertexNormal(pair_, f), {}};
    const int v = ExtremeVertex(q_, -pair_.ToQ(face.normal));
    face.feature_q = {FeatureKind::kVertex, v};
    face.ratio = RatioOf(pair_, face.normal, {p_.face(f)[0], v});
    return face;
  }

  TwinFace VertexFace(int f) const {
    TwinFace face{
        FaceClass::kVertexFace, {}, {FeatureKind::kFace, f}, VertexFaceNormal(pair_, f), {}};
    const int v = ExtremeVertex(p_, face.normal);
    face.feature_p = {FeatureKind::kVertex, v};
    face.ratio = RatioOf(pair_, face.normal, {v, q_.face(f)[0]});
    return face;
  }

  TwinFace EdgeEdge(int e_p, int e_q) const {
    TwinFace face{FaceClass::kEdgeEdge,
                  {FeatureKind::kEdge, e_p},
                  {FeatureKind::kEdge, e_q},
                  EdgeEdgeNormal(pair_, e_p, e_q),
                  {}};
    face.ratio =
        RatioOf(pair_, face.normal, {p_.topology().edges[e_p].tail, q_.topology().edges[e_q].tail});
    return face;
  }

  int FirstFace() const {
    const std::vector<IntegerVector>& normals = p_.normals().exact;
    int best = 0;
    for (int f = 1; f < p_.face_count; ++f) {
      if (FacesMore(normals[f], normals[best], pair_.v())) best = f;
    }
    return best;
  }

  TwinFace SearchFaceVertex() {
    return Ascend(
        Phase::kFaceVertex, p_, FirstFace(), [this](int f) { return FaceVertex(f); },
        [](const TwinFace& face) { return face.feature_p.index; });
  }

  TwinFace SearchVertexFace(int vertex_q) {
    return Ascend(
        Phase::kVertexFace, q_, q_.topology().vertex_faces[vertex_q].front(),
        [this](int f) { return VertexFace(f); },
        [](const TwinFace& face) { return face.feature_q.index; });
  }

  // SEARCH-FV, and SEARCH-VF: steepest ascent over the adjacency of one body's faces.
  template <class Evaluate, class FaceOf>
  TwinFace Ascend(Phase phase, const ExactBodyData& body, int start, const Evaluate& evaluate,
                  const FaceOf& face_of) {
    TwinFace best = evaluate(start);
    Visit(phase, best, true);
    while (!Exits(best)) {
      const int f = face_of(best);
      std::vector<TwinFace> neighbours;
      for (const int e : body.topology().face_edges[f]) {
        const ExactEdge& edge = body.topology().edges[e];
        neighbours.push_back(evaluate(edge.left == f ? edge.right : edge.left));
      }
      std::size_t k = 0;
      for (std::size_t j = 1; j < neighbours.size(); ++j) {
        if (Compare(neighbours[j].ratio, neighbours[k].ratio) > 0) k = j;
      }
      const bool better = Compare(neighbours[k].ratio, best.ratio) > 0;
      for (std::size_t j = 0; j < neighbours.size(); ++j)
        Visit(phase, neighbours[j], better && j == k);
      if (!better) break;
      best = neighbours[k];
    }
    Report(static_cast<int>(phase) - static_cast<int>(Phase::kFaceVertex), best,
           PhaseClaim::kMaximum);
    return best;
  }

  TwinFace SearchEdgeEdge(TwinFace best) {
    const bool from_p = best.face_class == FaceClass::kFaceVertex;
    const std::vector<int>& first_p = from_p ? p_.topology().face_edges[best.feature_p.index]
                                             : p_.topology().vertex_edges[best.feature_p.index];
    const std::vector<int>& first_q = from_p ? q_.topology().vertex_edges[best.feature_q.index]
                                             : q_.topology().face_edges[best.feature_q.index];
    std::vector<std::pair<int, int>> stack;
    for (const int e_p : first_p) {
      for (const int e_q : first_q) stack.emplace_back(e_p, e_q);
    }
    out_.result.phases[2].claim = PhaseClaim::kEmpty;
    std::optional<TwinFace> best_of_class;
    while (!Exits(best) && !stack.empty()) {
      const auto [e_p, e_q] = stack.back();
      stack.pop_back();
      ++counts(Phase::kEdgeEdge).arc_tests;
      if (!ArcsCross(pair_, e_p, e_q)) continue;
      const TwinFace face = EdgeEdge(e_p, e_q);
      if (!best_of_class.has_value() || Compare(face.ratio, best_of_class->ratio) > 0) {
        best_of_class = face;
      }
      const bool better = Compare(face.ratio, best.ratio) > 0;
      Visit(Phase::kEdgeEdge, face, better);
      if (!better) continue;
      best = face;
      for (const int e : IncidentEdges(q_, e_q)) stack.emplace_back(e_p, e);
      for (const int e : IncidentEdges(p_, e_p)) stack.emplace_back(e, e_q);
    }
    if (best_of_class.has_value()) Report(2, *best_of_class, PhaseClaim::kLocal);
    return best;
  }

  // The other edges at the two ends of an edge: at its tail, then at its head.
  static std::vector<int> IncidentEdges(const ExactBodyData& body, int e) {
    std::vector<int> incident;
    const ExactEdge& edge = body.topology().edges[e];
    for (const int end : {edge.tail, edge.head}) {
      for (const int other : body.topology().vertex_edges[end]) {
        if (other != e) incident.push_back(other);
      }
    }
    return incident;
  }

  bool Exits(const TwinFace& face) const {
    return options_.early_exit && cmp(face.ratio.numerator, face.ratio.denominator) > 0;
  }

  PhaseCounts& counts(Phase phase) { return out_.result.counts[static_cast<int>(phase)]; }

  double Distance(const TwinFace& face) const {
    return ValuesAt(pair_, face.normal, face.ratio).signed_distance.ToDouble();
  }

  void Visit(Phase phase, const TwinFace& face, bool accepted) {
    ++counts(phase).faces_visited;
    if (!options_.trace) return;
    out_.result.trace.push_back(
        {phase, face.face_class, face.feature_p, face.feature_q, Distance(face), accepted});
    out_.trace_ratio.push_back(ToRational(face.ratio));
  }

  void Report(int phase, const TwinFace& face, PhaseClaim claim) {
    out_.result.phases[phase] = {claim, face.face_class, face.feature_p, face.feature_q,
                                 Distance(face)};
    out_.phase_ratio[phase] = ToRational(face.ratio);
  }

  // Three vertices of the face of M, counterclockwise from outside.
  std::array<VertexPair, 3> Triangle(const TwinFace& face) const {
    std::array<VertexPair, 3> t;
    if (face.face_class == FaceClass::kFaceVertex) {
      const std::array<int, 3>& plane = p_.normals().plane[face.feature_p.index];
      for (int i = 0; i < 3; ++i) t[i] = {plane[i], face.feature_q.index};
    } else if (face.face_class == FaceClass::kVertexFace) {
      const std::array<int, 3>& plane = q_.normals().plane[face.feature_q.index];
      for (int i = 0; i < 3; ++i) t[i] = {face.feature_p.index, plane[i]};
    } else {
      const ExactEdge& e_p = p_.topology().edges[face.feature_p.index];
      const ExactEdge& e_q = q_.topology().edges[face.feature_q.index];
      t = {VertexPair{e_p.tail, e_q.tail}, {e_p.head, e_q.tail}, {e_p.tail, e_q.head}};
    }
    const IntegerVector a = pair_.FromC(t[0]);
    const IntegerVector n = Cross(pair_.FromC(t[1]) - a, pair_.FromC(t[2]) - a);
    if (DotSign(n, face.normal) < 0) std::swap(t[1], t[2]);
    return t;
  }

  void Finish(const TwinFace& best) {
    CollideResult& result = out_.result;
    const bool separate = cmp(best.ratio.numerator, best.ratio.denominator) > 0;
    result.verdict = separate ? Verdict::kSeparate : Verdict::kOverlap;
    result.tier = Tier::kNone;
    result.phase = best.face_class == FaceClass::kFaceVertex   ? Phase::kFaceVertex
                   : best.face_class == FaceClass::kVertexFace ? Phase::kVertexFace
                                                               : Phase::kEdgeEdge;
    out_.ratio = ToRational(best.ratio);
    for (int k = 0; k < 3; ++k) {
      result.interior_difference[k] = pair_.ToLength(Real(pair_.c()[k])).ToDouble();
    }
    result.termination = Exits(best) ? Termination::kEarlyExit : Termination::kOptimal;
    if (Exits(best)) return;
    result.face = ExitFace{best.face_class, best.feature_p, best.feature_q, Triangle(best)};
    const ExitValues values = ValuesAt(pair_, best.normal, best.ratio);
    result.signed_distance = Rounded(values.signed_distance);
    result.exit_travel = Rounded(values.exit_travel);
    result.exit_point.emplace();
    for (int k = 0; k < 3; ++k) (*result.exit_point)[k] = values.exit_point[k].ToDouble();
    result.exit_point_error = 0x1p-52 * result.exit_point->norm();
  }

  static BoundedValue Rounded(const Real& exact) {
    const double value = exact.ToDouble();
    return {value, 0x1p-52 * std::abs(value), 1.0};
  }

  const PlacedPair& pair_;
  const TwinOptions& options_;
  const ExactBodyData& p_;
  const ExactBodyData& q_;
  TwinResult out_;
};

}  // namespace

TwinResult RunPublishedTwin(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
                            int interior_p, int interior_q, const TwinOptions& options) {
  const PlacedPair pair(p.data(), q.data(), pose, interior_p, interior_q);
  TwinResult twin = Twin(pair, options).Run();
  twin.result.interior_p = interior_p;
  twin.result.interior_q = interior_q;
  return twin;
}

std::vector<Finding> JudgeTwin(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
                               const TwinResult& twin, const TwinOptions& options) {
  std::vector<Finding> findings;
  const int interior_p = twin.result.interior_p, interior_q = twin.result.interior_q;
  const ExactDecision truth = Decide(p, q, pose, interior_p, interior_q);
  const bool separate = truth.verdict == Verdict::kSeparate;
  if (separate != (twin.result.verdict == Verdict::kSeparate)) {
    findings.push_back({FindingKind::kWrongVerdict,
                        separate ? "says overlap, is separate" : "says separate, is not"});
  }
  if (options.early_exit || !truth.exit.has_value()) return findings;
  const PlacedPair pair(p.data(), q.data(), pose, interior_p, interior_q);
  if (*twin.phase_ratio[0] != ToRational(FaceVertexMaximum(pair))) {
    findings.push_back(
        {FindingKind::kPhaseNotMaximal, "SEARCH-FV ended below the maximum of its class"});
  }
  if (*twin.phase_ratio[1] != ToRational(VertexFaceMaximum(pair))) {
    findings.push_back(
        {FindingKind::kPhaseNotMaximal, "SEARCH-VF ended below the maximum of its class"});
  }
  if (twin.ratio != 1 / truth.exit->parameter) {
    findings.push_back(
        {FindingKind::kPhaseNotMaximal, "SEARCH-EE ended below the maximum over F(M)"});
    findings.push_back(
        {FindingKind::kNotOptimal, "the final face is not the one the ray leaves by"});
  }
  return findings;
}

}  // namespace touchstone::exact
