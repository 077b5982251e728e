// SPDX-License-Identifier: MIT
#include "touchstone/tools/cpd_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ostream>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/local_sum.h"
#include "touchstone/exact/judge_cpd.h"
#include "touchstone/tools/bench/times.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/table.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;
using Eigen::Vector3d;

double Since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

struct Times {
  std::vector<double> ms;

  double At(double part) const { return Quantile(ms, part); }
  CpdBenchRow Row(const std::string& scene, const std::string& method) const {
    return {scene, method, At(0.5), At(0.99), static_cast<int>(ms.size()), 0, 0, 0, 0};
  }
};

// What answers claim, beyond the residual in doubles: corners are rounded, by 2^-44 of the size
// where planes meet well and 2^-32 at worst, and angles at corners by that over the length of
// sides.
constexpr double kPhongRounding = 0x1p-32;  // of the size
constexpr double kPhongResidual = 1e-8;

// Enough for steps of a degree, of which 1000 are small, and 30 bisections on the way.
constexpr int kStepsOfABisection = 4000;

void WriteDirection(const Vector3d& q, std::ostream& out) {
  const Vector3d u = q.stableNormalized();
  out << ',' << ShortDouble(q.norm());
  for (int k = 0; k < 3; ++k) out << ',' << ShortDouble(u[k]);
}

Vector3d TranslationOf(const CpdFrame& frame, int method) {
  return method == 0   ? frame.cpd.translation
         : method == 1 ? frame.depth.translation
                       : frame.contact_space.translation;
}

}  // namespace

std::optional<ContinuousDepthOptions> NormalsFromWord(const std::string& word) {
  ContinuousDepthOptions options;
  if (word == "angle") return options;
  if (word == "area") {
    options.weights = NormalWeights::kArea;
  } else if (word == "uniform") {
    options.weights = NormalWeights::kUniform;
  } else if (word == "interpolated") {
    options.interpolation = PhongInterpolation::kNormals;
  } else if (word == "mean") {
    options.normal_radius = kMeanNormalRadius;
  } else {
    return std::nullopt;
  }
  return options;
}

std::vector<CpdFrame> RunCpdScene(const PaperScene& scene, int frames,
                                  const ContinuousDepthOptions& options) {
  const TriangleMesh a = MustBuild(scene.a), b = MustBuild(scene.b);
  const ContactBody body_a(a), body_b(b);
  ContinuousPenetrationDepth cpd(a, b, options);
  MeshPair pair(a, b, scene.PoseAt(0.0));
  MeshDepthCache depth_cache;
  ContactSpaceCache contact_cache;
  std::vector<CpdFrame> out;
  for (int i = 0; i < frames; ++i) {
    CpdFrame frame;
    frame.s = frames > 1 ? static_cast<double>(i) / (frames - 1) : 0.0;
    const RelativePose pose = scene.PoseAt(frame.s);
    pair.Place(pose);
    frame.cpd = cpd.Update(pose);
    frame.depth = MeshPenetrationDepth(pair, body_a, body_b, {}, &depth_cache);
    frame.contact_space = ContactSpaceProjection(pair, {}, &contact_cache);
    out.push_back(frame);
  }
  return out;
}

void WriteCpdCsv(const std::vector<CpdFrame>& frames, std::ostream& out) {
  out << "s,status,branch";
  for (const char* method : {"cpd", "depth", "contact_space"}) {
    out << ',' << method << ',' << method << "_x," << method << "_y," << method << "_z";
  }
  out << '\n';
  for (const CpdFrame& frame : frames) {
    out << ShortDouble(frame.s) << ',' << ToString(frame.cpd.status) << ',' << frame.cpd.branch;
    for (int method = 0; method < 3; ++method) WriteDirection(TranslationOf(frame, method), out);
    out << '\n';
  }
}

void WriteCpdSvg(const std::string& title, const std::vector<CpdFrame>& frames, std::ostream& out) {
  constexpr double kWidth = 720.0, kHeight = 170.0, kLeft = 60.0, kTop = 40.0, kGap = 30.0;
  constexpr const char* kColours[] = {"#c0392b", "#2c3e50", "#27ae60"};
  constexpr const char* kNames[] = {"CPD", "global depth", "contact-space projection"};
  constexpr const char* kPanels[] = {"magnitude", "direction x", "direction y", "direction z"};
  double most = 1e-300;
  for (const CpdFrame& frame : frames) {
    for (int method = 0; method < 3; ++method) {
      most = std::max(most, TranslationOf(frame, method).norm());
    }
  }
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << kLeft + kWidth + 20
      << "\" height=\"" << kTop + 4 * (kHeight + kGap)
      << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
         "fill=\"white\"/>\n<text x=\""
      << kLeft << "\" y=\"18\" font-size=\"14\">" << title << "</text>\n";
  for (int method = 0; method < 3; ++method) {
    out << "<text x=\"" << kLeft + 200 + 150 * method << "\" y=\"18\" fill=\"" << kColours[method]
        << "\">" << kNames[method] << "</text>\n";
  }
  for (int panel = 0; panel < 4; ++panel) {
    const double top = kTop + panel * (kHeight + kGap);
    const double low = panel == 0 ? 0.0 : -1.0, high = panel == 0 ? 1.05 * most : 1.0;
    out << "<rect x=\"" << kLeft << "\" y=\"" << top << "\" width=\"" << kWidth << "\" height=\""
        << kHeight << "\" fill=\"none\" stroke=\"#999\"/>\n<text x=\"" << kLeft << "\" y=\""
        << top - 5 << "\">" << kPanels[panel] << "</text>\n<text x=\"5\" y=\"" << top + 10 << "\">"
        << Fixed(high, 2) << "</text>\n<text x=\"5\" y=\"" << top + kHeight << "\">"
        << Fixed(low, 2) << "</text>\n";
    for (int method = 2; method >= 0; --method) {
      out << "<polyline fill=\"none\" stroke=\"" << kColours[method] << "\" points=\"";
      for (const CpdFrame& frame : frames) {
        const Vector3d q = TranslationOf(frame, method);
        const double value = panel == 0 ? q.norm() : q.stableNormalized()[panel - 1];
        out << kLeft + kWidth * frame.s << ','
            << top + kHeight * (1.0 - (value - low) / (high - low)) << ' ';
      }
      out << "\"/>\n";
    }
  }
  out << "</svg>\n";
}

bool IsSmallStep(const Vector3d& p, const Vector3d& q) {
  if ((p - q).norm() > 1e-3 * kPaperSumRadius) return false;
  if (p.isZero() || q.isZero()) return p.isZero() && q.isZero();
  return p.normalized().dot(q.normalized()) >= 0.9998476951563913;  // cos 1°
}

bool HasJump(const std::function<Vector3d(double)>& at, double from, double to) {
  Vector3d p = at(from), q = at(to);
  for (int i = 0; i < kBisections && !IsSmallStep(p, q); ++i) {
    const double middle = 0.5 * (from + to);
    const Vector3d x = at(middle);
    // On to the half with the larger change.
    if ((x - p).norm() > (q - x).norm()) {
      to = middle, q = x;
    } else {
      from = middle, p = x;
    }
  }
  return !IsSmallStep(p, q);
}

CpdEvent FindCpdEvent(const PaperScene& scene, ContinuousPenetrationDepth* solver,
                      const ContinuousDepthState& state, double from, double to) {
  ContinuousDepthState here = state;
  double width = to - from;
  const double least = std::ldexp(width, -kBisections);
  for (int i = 0; i < kStepsOfABisection && from < to; ++i) {
    const double next = from + width < to ? from + width : to;
    solver->set_state(here);
    const ContinuousDepthResult result = solver->Update(scene.PoseAt(next));
    const auto there = solver->state();
    if (there && IsSmallStep(here.translation, result.translation)) {
      here = *there;
      from = next;
      width *= 2.0;
    } else if (width <= least) {
      return {true, result.iterations > 0};
    } else {
      width *= 0.5;
    }
  }
  return {from < to, false};
}

std::vector<std::string> JudgedMeshDepth(const TriangleMesh& a, const TriangleMesh& b,
                                         const RelativePose& pose, const MeshDepthResult& result,
                                         int samples) {
  exact::DepthJudgeOptions options;
  options.facet_samples = samples;
  options.ball_samples = std::max(4, samples / 3);
  return exact::JudgeMeshDepth(a, b, pose,
                               {result.translation, result.lower_bound, result.upper_bound,
                                result.is_exact || result.by_boundary},
                               options);
}

std::vector<std::string> JudgedPhong(const TriangleMesh& a, const TriangleMesh& b,
                                     const RelativePose& pose,
                                     const ContinuousPenetrationDepth& solver,
                                     const ContinuousDepthOptions& options,
                                     const ContinuousDepthResult& result,
                                     double depth_lower_bound) {
  const auto patch = solver.patch();
  if (!patch) return {};
  const double size = 1.0 / MeshPair(a, b, pose).scale();
  exact::PhongClaim claim;
  claim.translation = result.translation;
  claim.rounding = kPhongRounding * size;
  claim.residual = std::max(result.residual, kPhongResidual);
  claim.depth_lower_bound = depth_lower_bound;
  claim.at = patch->at;
  claim.facets = patch->facets;
  claim.names = patch->names;
  claim.triangles = patch->triangles;
  claim.facet_of_triangle = patch->facet_of_triangle;
  claim.normals = static_cast<exact::PhongNormals>(options.weights);
  claim.interpolated = options.interpolation == PhongInterpolation::kNormals;
  if (options.normal_radius > 0.0) {
    claim.normals = exact::PhongNormals::kMean;
    claim.interpolated = false;
    claim.mean_radius = result.normal_radius;
  }
  std::vector<std::string> findings = exact::JudgePhong(a, b, pose, claim);
  // Without a branch to follow, it is the nearest of all local solutions.
  if (!options.track_branch && claim.normals == exact::PhongNormals::kAngle &&
      !claim.interpolated) {
    const LocalSum& sum = solver.local_sum();
    const auto nearer = exact::FindNearerPhong(sum.vertices, sum.triangles, sum.triangle_normals,
                                               result.translation.norm());
    findings.insert(findings.end(), nearer.begin(), nearer.end());
  }
  return findings;
}

PremiseRow MeasurePremise(const PaperScene& scene, int moments, int frames) {
  constexpr double kDegrees = 57.29577951308232, kPremise = 10.0;
  const TriangleMesh a = MustBuild(scene.a), b = MustBuild(scene.b);
  const auto above = [](const Times& angles) {
    const auto count = std::count_if(angles.ms.begin(), angles.ms.end(),
                                     [](double angle) { return angle > kPremise; });
    return static_cast<double>(count) /
           std::max<double>(1.0, static_cast<double>(angles.ms.size()));
  };
  Times all, at_solutions;
  LocalMinkowskiSum whole(a, b, {LocalBuilder::kFull});
  for (int i = 0; i < moments; ++i) {
    const LocalSum& sum =
        whole.Update(scene.PoseAt((i + 0.5) / moments), {Vector3d::Zero(), 8.0 * kPaperSumRadius});
    const PhongSurface surface = {sum.vertices, sum.triangles, sum.neighbors, sum.vertex_normals};
    for (int t = 0; t < static_cast<int>(sum.triangles.size()); ++t) {
      all.ms.push_back(kDegrees * CornerAngle(surface, t));
    }
  }
  ContinuousPenetrationDepth solver(a, b, {.keep_patch = false});
  for (int i = 0; i < frames; ++i) {
    solver.Forget();
    const ContinuousDepthResult result = solver.Update(scene.PoseAt((i + 0.5) / frames));
    if (result.status != ContinuousDepthStatus::kFound) continue;
    at_solutions.ms.push_back(kDegrees * result.corner_angle);
  }
  return {scene.name,
          moments,
          static_cast<long>(all.ms.size()),
          all.At(0.5),
          above(all),
          static_cast<int>(at_solutions.ms.size()),
          at_solutions.At(0.5),
          above(at_solutions)};
}

namespace {

// Where bench motions begin, and how far s goes in a frame of a tenth of a degree.
constexpr double kBenchBegin = 0.3;
double TenthOf(const PaperScene& scene) { return scene.AtTurn(0.1) - scene.AtTurn(0.0); }

// CPD along a bench motion.
struct CpdBenchRun {
  Times mink, phong, total;
  int without = 0;  // frames that have no projection
  int events = 0, combinatorial = 0, findings = 0;
};

CpdBenchRun BenchCpd(const PaperScene& scene, const ContinuousDepthOptions& how,
                     const CpdBenchOptions& options, const std::function<bool()>& has_time) {
  struct Suspect {
    double from, to;
    ContinuousDepthState state;
  };
  CpdBenchRun run;
  ContinuousPenetrationDepth cpd(MustBuild(scene.a), MustBuild(scene.b), how);
  std::vector<Suspect> suspects;
  std::optional<ContinuousDepthState> before;
  const double tenth = TenthOf(scene);
  for (int i = 0; i < options.frames && has_time(); ++i) {
    const double s = kBenchBegin + i * tenth;
    const RelativePose pose = scene.PoseAt(s);
    const double at = ProcessorMs();
    const ContinuousDepthResult result = cpd.Update(pose);
    if (i > 0) {  // the first is cold
      // The solver's own times are by the clock: they say how the processor's was shared out.
      const double spent = ProcessorMs() - at, part = spent / std::max(result.total_ms, 1e-9);
      run.mink.ms.push_back(part * result.minkowski_ms);
      run.phong.ms.push_back(part * result.phong_ms);
      run.total.ms.push_back(spent);
    }
    run.without += result.status != ContinuousDepthStatus::kFound;
    run.findings += result.status == ContinuousDepthStatus::kFound && !(result.residual < 1e-10);
    if (before && !IsSmallStep(before->translation, result.translation)) {
      suspects.push_back({s - tenth, s, *before});
    }
    before = cpd.state();
  }
  int bisected = 0;
  for (const Suspect& suspect : suspects) {
    if (bisected >= options.bisected_steps || !has_time()) {
      ++run.events;  // not looked into: counted
      continue;
    }
    ++bisected;
    const CpdEvent event = FindCpdEvent(scene, &cpd, suspect.state, suspect.from, suspect.to);
    run.events += event.jumps;
    run.combinatorial += event.jumps && event.by_combinatorics;
  }
  return run;
}

}  // namespace

std::vector<CpdBenchRow> BenchCpdScene(const PaperScene& scene, const CpdBenchOptions& options) {
  const TriangleMesh a = MustBuild(scene.a), b = MustBuild(scene.b);
  const ContactBody body_a(a), body_b(b);
  MeshPair pair(a, b, scene.PoseAt(0.0));
  // Coherent: a tenth of a degree a frame from a third of the motion on; a degree; and cold, all
  // along it.
  const double begin = kBenchBegin, tenth = TenthOf(scene), degree = 10.0 * tenth;
  const auto start = Clock::now();
  const auto has_time = [&] { return Since(start) < 1e3 * options.seconds; };
  const CpdBenchRun by_angle = BenchCpd(scene, {}, options, has_time);
  const CpdBenchRun by_mean =
      BenchCpd(scene, {.normal_radius = kMeanNormalRadius}, options, has_time);

  MeshDepthCache cache;
  const auto depth_at = [&](double s) {
    pair.Place(scene.PoseAt(s));
    return MeshPenetrationDepth(pair, body_a, body_b, {}, &cache);
  };
  const auto timed_depth = [&](double s, Times* times) {
    pair.Place(scene.PoseAt(s));
    const double at = ProcessorMs();
    const MeshDepthResult result = MeshPenetrationDepth(pair, body_a, body_b, {}, &cache);
    times->ms.push_back(ProcessorMs() - at);
    return result;
  };
  Times cold, coherent, coarse;
  int depth_findings = 0, jumps = 0;
  for (int i = 0; i < options.frames; ++i) {
    cache.Clear();
    const double s = (i + 0.5) / options.frames;
    const MeshDepthResult result = timed_depth(s, &cold);
    depth_findings += result.status != MeshDepthStatus::kCertain;
    const int every = std::max(1, options.frames / std::max(1, options.judged_frames));
    if (options.judged_frames > 0 && i % every == 0 && has_time()) {
      depth_findings += static_cast<int>(JudgedMeshDepth(a, b, scene.PoseAt(s), result, 12).size());
    }
  }
  Vector3d last = Vector3d::Zero();
  for (int i = 0; i < options.frames; ++i) {
    const double s = begin + i * tenth;
    const Vector3d q = timed_depth(s, &coherent).translation;
    if (i > 0 && !IsSmallStep(last, q)) {
      jumps += HasJump([&](double x) { return depth_at(x).translation; }, s - tenth, s);
    }
    last = q;
  }
  for (int i = 0; i < options.frames; ++i) timed_depth(begin + std::fmod(i * degree, 0.7), &coarse);

  ContactSpaceCache contact_cache;
  Times contact_cold, contact_coherent;
  int deeper = 0;
  const auto timed_contact = [&](double s, Times* times) {
    pair.Place(scene.PoseAt(s));
    const double at = ProcessorMs();
    const ContactSpaceResult result = ContactSpaceProjection(pair, {}, &contact_cache);
    times->ms.push_back(ProcessorMs() - at);
    // Never shorter than the global depth, or that was wrong.
    deeper += result.translation.norm() < depth_at(s).lower_bound * (1.0 - 1e-9);
  };
  for (int i = 0; i < options.frames; ++i) {
    contact_cache.last.reset();
    timed_contact((i + 0.5) / options.frames, &contact_cold);
  }
  for (int i = 0; i < options.frames; ++i) timed_contact(begin + i * tenth, &contact_coherent);

  const auto cpd_total = [&](const CpdBenchRun& run, const std::string& method) {
    CpdBenchRow row = run.total.Row(scene.name, method);
    row.events = run.events;
    row.jumps = jumps + run.without;
    row.combinatorial = run.combinatorial;
    row.findings = run.findings + (row.events > row.jumps ? 1 : 0);
    return row;
  };
  std::vector<CpdBenchRow> rows = {by_angle.mink.Row(scene.name, "cpd-minkowski"),
                                   by_angle.phong.Row(scene.name, "cpd-phong"),
                                   cpd_total(by_angle, "cpd-total"),
                                   cpd_total(by_mean, "cpd-mean-normals"),
                                   cold.Row(scene.name, "depth-cold"),
                                   coherent.Row(scene.name, "depth-coherent-0.1"),
                                   coarse.Row(scene.name, "depth-coherent-1"),
                                   contact_cold.Row(scene.name, "contact-space-cold"),
                                   contact_coherent.Row(scene.name, "contact-space-coherent")};
  rows[4].findings = depth_findings;
  rows[5].jumps = jumps;
  rows[7].findings = deeper;
  return rows;
}

}  // namespace touchstone
