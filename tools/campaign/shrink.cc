// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/shrink.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <stdexcept>
#include <utility>
#include <vector>

#include "touchstone/tools/campaign/batch.h"
#include "touchstone/tools/campaign/pipes.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

// Everything is looked at but M built whole; no early exit.
constexpr SamplingRates kEverything = {
    .maxima = 1, .construct = 0, .warm = 1, .early_exit = 0, .values = 1};

[[noreturn]] void Answer(const std::string& engine, const PlacedPair& pair, int out) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  BatchResult result;
  try {
    const auto contestants = MakeContestants({engine});
    ExactBodies bodies;
    const CampaignQuery query(pair, 0, kEverything, bodies);
    EngineTally tally;
    try {
      for (const NamedFinding& finding : contestants.front()->Ask(query, tally))
        result.findings.push_back({engine, 0, finding.kind, finding.detail});
    } catch (const std::exception& error) {
      result.findings.push_back({engine, 0, "exception", error.what()});
    }
  } catch (...) {
    _exit(1);
  }
  WriteMessage(out, ToText(result));
  _exit(0);
}

// What came through the pipe before it closed or the time was up; nothing for the latter.
std::optional<std::string> ReadFor(int pipe, double seconds) {
  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                   std::chrono::duration<double>(seconds));
  std::string received;
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd descriptor{pipe, POLLIN, 0};
    if (left <= 0 || poll(&descriptor, 1, static_cast<int>(left)) == 0) return std::nullopt;
    if (!ReadSome(pipe, received)) return received;
  }
}

std::optional<PlacedPair> WithHulls(const PlacedPair& pair, std::vector<Eigen::Vector3d> p,
                                    std::vector<Eigen::Vector3d> q) {
  const StatusOr<ConvexPolyhedron> body_p = HullBody(p, FacetStyle::kMerged);
  const StatusOr<ConvexPolyhedron> body_q = HullBody(q, FacetStyle::kMerged);
  if (!body_p.ok() || !body_q.ok()) return std::nullopt;
  return PlacedPair{*body_p, *body_q, pair.pose};
}

std::vector<Eigen::Vector3d> Points(const ConvexPolyhedron& body) {
  return {body.vertices().begin(), body.vertices().end()};
}

// To `digits` decimals after the first of `size`; -1: to zero.
double Rounded(double x, double size, int digits) {
  if (digits < 0) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(size)) - digits);
  // A division by a whole power of ten gives the double nearest to a short decimal.
  const double scaled = std::nearbyint(x / unit) + 0.0;  // not -0
  return unit < 1.0 ? scaled / std::nearbyint(1.0 / unit) : scaled * unit;
}

class Shrinker {
 public:
  Shrinker(PlacedPair best, double seconds, const std::function<bool(const PlacedPair&)>& holds)
      : best_(std::move(best)),
        end_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))),
        holds_(holds) {
    best_.expected.reset();
  }

  PlacedPair Run() {
    // From coarse to fine: what is gained first makes the rest cheap.
    bool gained = true;
    while (gained && !TimeIsUp()) {
      gained = false;
      gained |= DropVertices(true);
      gained |= DropVertices(false);
      gained |= SimplifyPose();
      gained |= SimplifyVertices(true);
      gained |= SimplifyVertices(false);
    }
    return best_;
  }

 private:
  bool TimeIsUp() const { return Clock::now() >= end_; }

  bool Try(const std::optional<PlacedPair>& candidate) {
    if (!candidate || TimeIsUp() || !holds_(*candidate)) return false;
    best_ = *candidate;
    return true;
  }

  std::vector<Eigen::Vector3d> PointsOf(bool of_p) const {
    return Points(of_p ? best_.p : best_.q);
  }
  std::optional<PlacedPair> WithPoints(bool of_p, std::vector<Eigen::Vector3d> points) const {
    return of_p ? WithHulls(best_, std::move(points), Points(best_.q))
                : WithHulls(best_, Points(best_.p), std::move(points));
  }

  // In chunks of half the vertices, then a quarter, down to one.
  bool DropVertices(bool of_p) {
    bool gained = false;
    for (std::size_t chunk = PointsOf(of_p).size() / 2; chunk > 0; chunk /= 2) {
      for (std::size_t begin = 0; begin < PointsOf(of_p).size() && !TimeIsUp();) {
        std::vector<Eigen::Vector3d> points = PointsOf(of_p);
        const std::size_t end = std::min(points.size(), begin + chunk);
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(begin),
                     points.begin() + static_cast<std::ptrdiff_t>(end));
        if (points.size() >= 4 && Try(WithPoints(of_p, points))) {
          gained = true;
        } else {
          begin += chunk;
        }
      }
    }
    return gained;
  }

  bool TryPose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
    if (!best_.pose.world() && rotation == best_.pose.rotation() &&
        translation == best_.pose.translation()) {
      return false;
    }
    const StatusOr<RelativePose> pose = RelativePose::Make(rotation, translation);
    if (!pose.ok()) return false;
    return Try(PlacedPair{best_.p, best_.q, *pose});
  }

  bool SimplifyPose() {
    bool gained = TryPose(Eigen::Matrix3d::Identity(), best_.pose.translation());
    // The nearest rotation that maps axes to axes.
    const Eigen::Matrix3d axes = best_.pose.rotation().array().round().matrix();
    gained |= TryPose(axes, best_.pose.translation());
    if (best_.pose.world()) gained |= TryPose(best_.pose.rotation(), best_.pose.translation());
    if (!gained) gained |= RoundRotation();
    const double size = std::max(best_.p.max_coordinate(), best_.q.max_coordinate());
    for (int i = 0; i < 3; ++i) {
      gained |= RoundNumber(size, best_.pose.translation()[i], [&](double value) {
        Eigen::Vector3d translation = best_.pose.translation();
        translation[i] = value;
        return TryPose(best_.pose.rotation(), translation);
      });
    }
    return gained;
  }

  // All entries at once, or R is soon no rotation.
  bool RoundRotation() {
    for (int digits = 8; digits <= 14; ++digits) {
      Eigen::Matrix3d rotation = best_.pose.rotation();
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) rotation(i, j) = Rounded(rotation(i, j), 1.0, digits);
      }
      if (rotation == best_.pose.rotation()) return false;
      if (TryPose(rotation, best_.pose.translation())) return true;
    }
    return false;
  }

  // The shortest decimal that the finding survives.
  template <class Replace>
  bool RoundNumber(double size, double value, Replace replace) {
    for (int digits = -1; digits <= 15 && !TimeIsUp(); ++digits) {
      const double rounded = Rounded(value, size, digits);
      if (rounded == value) return false;
      if (replace(rounded)) return true;
    }
    return false;
  }

  bool SimplifyVertices(bool of_p) {
    // All of them at once first: one question instead of many.
    bool gained = false;
    const double size = (of_p ? best_.p : best_.q).max_coordinate();
    for (int digits = 0; digits <= 3 && !gained; ++digits) {
      std::vector<Eigen::Vector3d> points = PointsOf(of_p);
      for (Eigen::Vector3d& point : points) {
        for (int k = 0; k < 3; ++k) point[k] = Rounded(point[k], size, digits);
      }
      if (points == PointsOf(of_p)) return false;
      gained = Try(WithPoints(of_p, points));
    }
    // The hull may number its vertices anew; a pass over the numbers as they stand will do.
    for (std::size_t v = 0; v < PointsOf(of_p).size() && !TimeIsUp(); ++v) {
      for (int k = 0; k < 3; ++k) {
        if (v >= PointsOf(of_p).size()) break;
        gained |= RoundNumber(size, PointsOf(of_p)[v][k], [&](double value) {
          std::vector<Eigen::Vector3d> points = PointsOf(of_p);
          if (v >= points.size()) return false;
          points[v][k] = value;
          return Try(WithPoints(of_p, points));
        });
      }
    }
    return gained;
  }

  PlacedPair best_;
  Clock::time_point end_;
  const std::function<bool(const PlacedPair&)>& holds_;
};

}  // namespace

std::vector<NamedFinding> AskApart(const std::string& engine, const PlacedPair& pair,
                                   double hang_seconds) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe for a query");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process for a query");
  if (child == 0) {
    close(ends[0]);
    Answer(engine, pair, ends[1]);
  }
  close(ends[1]);
  std::optional<std::string> received = ReadFor(ends[0], hang_seconds);
  if (!received) kill(child, SIGKILL);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!received) return {{"hang", "no answer"}};
  const std::optional<std::string> message = TakeMessage(*received);
  if (!message) {
    const std::string how = WIFSIGNALED(status)
                                ? "signal " + std::to_string(WTERMSIG(status))
                                : "exit code " + std::to_string(WEXITSTATUS(status));
    return {{"crash", "ended by " + how}};
  }
  std::vector<NamedFinding> findings;
  for (const CampaignFinding& finding : BatchResultFromText(*message).findings)
    findings.push_back({finding.kind, finding.detail});
  return findings;
}

PlacedPair ShrinkWhile(const PlacedPair& pair, double seconds,
                       const std::function<bool(const PlacedPair&)>& holds) {
  return Shrinker(pair, seconds, holds).Run();
}

std::optional<PlacedPair> Shrink(const std::string& engine, const std::string& kind,
                                 const PlacedPair& pair, const ShrinkOptions& options) {
  const auto holds = [&](const PlacedPair& candidate) {
    const std::vector<NamedFinding> findings = AskApart(engine, candidate, options.hang_seconds);
    return std::any_of(findings.begin(), findings.end(),
                       [&](const NamedFinding& finding) { return finding.kind == kind; });
  };
  PlacedPair first = pair;
  first.expected.reset();
  if (!holds(first)) return std::nullopt;
  return ShrinkWhile(first, options.seconds, holds);
}

}  // namespace touchstone
