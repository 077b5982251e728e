// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/workload.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include "touchstone/exact/decide.h"
#include "touchstone/tools/mesh_io.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/suites/arithmetic.h"
#include "touchstone/tools/suites/random.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr std::string_view kParallel = "parallel";
constexpr int kFewestMixedBodies = 16;

std::optional<double> EllipsoidAspect(const std::string& shape) {
  constexpr std::string_view kPrefix = "ellipsoid-";
  if (!shape.starts_with(kPrefix)) return std::nullopt;
  const std::optional<double> aspect = ParseDouble(shape.substr(kPrefix.size()));
  return aspect && *aspect > 0.0 && *aspect <= 1e6 ? aspect : std::nullopt;
}

Eigen::Vector2d CirclePoint(Random& random) {
  for (;;) {
    const Eigen::Vector2d v(random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0));
    const double squared = v[0] * v[0] + v[1] * v[1];
    if (squared > 0.01 && squared <= 1.0) return v / std::sqrt(squared);
  }
}

// The hull of `points`, or of what `again` draws next should they span no body.
template <class Draw>
ConvexPolyhedron HullOf(Draw draw) {
  for (;;) {
    StatusOr<ConvexPolyhedron> body = HullBody(draw(), FacetStyle::kMerged);
    if (body.ok()) return *body;
  }
}

ConvexPolyhedron Prism(Random& random, int n, double half_height) {
  return HullOf([&] {
    std::vector<Vector3d> points;
    for (int i = 0; i < std::max(3, n / 2); ++i) {
      const Eigen::Vector2d point = 100.0 * CirclePoint(random);
      for (const double z : {-half_height, half_height}) points.emplace_back(point[0], point[1], z);
    }
    return points;
  });
}

ConvexPolyhedron Bipyramid(Random& random, int n) {
  return HullOf([&] {
    std::vector<Vector3d> points = {{0.0, 0.0, -100.0}, {0.0, 0.0, 100.0}};
    for (int i = 0; i < std::max(3, n - 2); ++i) {
      const Eigen::Vector2d point = 100.0 * CirclePoint(random);
      points.emplace_back(point[0], point[1], 0.0);
    }
    return points;
  });
}

// The lattice points in a ball of radius r have a hull of about 6 r^1.5 corners (measured). The
// centre is random; coordinates are integers times a power of two.
// centre is random; coordinates are integers times a power of two.
ConvexPolyhedron GridHull(Random& random, int n) {
  const double radius = std::pow(n / 6.0, 2.0 / 3.0);
  const double scale = std::ldexp(1.0, static_cast<int>(std::lround(std::log2(100.0 / radius))));
  return HullOf([&] {
    const Vector3d center(random.Unit(), random.Unit(), random.Unit());
    std::vector<Vector3d> points;
    const int reach = static_cast<int>(radius) + 2;
    for (int x = -reach; x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        const double dx = x - center[0], dy = y - center[1];
        const double room = radius * radius - dx * dx - dy * dy;
        if (room < 0.0) continue;
        const double low = std::ceil(center[2] - std::sqrt(room));
        const double high = std::floor(center[2] + std::sqrt(room));
        if (low > high) continue;
        points.emplace_back(x * scale, y * scale, low * scale);
        points.emplace_back(x * scale, y * scale, high * scale);
      }
    }
    return points;
  });
}

// The hulls of the closed meshes in a folder, scaled by a power of two to a size of about 100; read
// once.
const std::vector<ConvexPolyhedron>& MeshHulls(const std::string& directory) {
  static std::map<std::string, std::vector<ConvexPolyhedron>> read;
  const auto [entry, is_new] = read.try_emplace(directory);
  if (!is_new || directory.empty()) return entry->second;
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& file : std::filesystem::directory_iterator(directory, error)) {
    if (file.path().extension() == ".off") paths.push_back(file.path().string());
  }
  std::sort(paths.begin(), paths.end());
  for (const std::string& path : paths) {
    Loaded<PolygonSoup> soup = ReadPolygonSoup(path);
    if (!soup.ok() || !soup->IsClosed()) continue;
    std::vector<Vector3d> points = soup->points;
    const double size = PlainMaxCoordinate(points);
    if (!(size > 0.0)) continue;
    const double scale = std::exp2(std::round(std::log2(100.0 / size)));
    for (Vector3d& point : points) point *= scale;
    StatusOr<ConvexPolyhedron> hull = HullBody(points, FacetStyle::kMerged);
    if (hull.ok()) entry->second.push_back(*hull);
  }
  return entry->second;
}

std::optional<ConvexPolyhedron> MakeBody(const WorkloadKey& key, Random& random) {
  if (const auto aspect = EllipsoidAspect(key.shape)) {
    return EllipsoidBody(random, key.n, Vector3d(100.0 * *aspect, 100.0, 100.0));
  }
  if (key.shape == "prism" || key.shape == kParallel) return Prism(random, key.n, 100.0);
  if (key.shape == "slab") return Prism(random, key.n, 2.0);
  if (key.shape == "bipyramid") return Bipyramid(random, key.n);
  if (key.shape == "grid") return GridHull(random, key.n);
  std::vector<ConvexPolyhedron> near;
  for (const ConvexPolyhedron& hull : MeshHulls(key.meshes_dir)) {
    if (2 * hull.vertex_count() >= key.n && hull.vertex_count() <= 2 * key.n) near.push_back(hull);
  }
  if (near.empty()) return std::nullopt;
  return near[random.Below(near.size())];
}

Random Stream(const WorkloadKey& key, std::string_view mode) {
  return Random(key.shape + "/" + std::string(mode), key.seed, static_cast<std::uint64_t>(key.n));
}

// False where there is no such body.
bool AddBodies(const WorkloadKey& key, int count, Random& random, Workload* workload) {
  for (int i = 0; i < count; ++i) {
    std::optional<ConvexPolyhedron> body = MakeBody(key, random);
    if (!body) return false;
    workload->bodies.push_back(*body);
    workload->exact_bodies.emplace_back(*body);
  }
  return true;
}

struct Course {
  Matrix3d rotation;
  Vector3d direction;
};

Course RandomCourse(const WorkloadKey& key, Random& random) {
  if (key.shape == kParallel) {
    // The third row and column are exact, and so are the heights of the faces.
    const Eigen::Vector2d x = CirclePoint(random);
    Course course{Matrix3d::Identity(), Vector3d::UnitZ()};
    course.rotation.topLeftCorner<2, 2>() << x[0], -x[1], x[1], x[0];
    return course;
  }
  const Matrix3d rotation = random.Rotation();
  return {rotation, random.SpherePoint()};
}

void AddLine(Workload& workload, int p, int q, const Matrix3d& rotation,
             const Vector3d& direction) {
  workload.lines.push_back(
      {p, q, FindContactLine(workload.bodies[p], workload.bodies[q], rotation, direction)});
}

// The rotation by `angle` about a unit axis (Rodrigues).
Matrix3d RotationAbout(const Vector3d& axis, double angle) {
  Matrix3d k;
  k << 0.0, -axis[2], axis[1], axis[2], 0.0, -axis[0], -axis[1], axis[0], 0.0;
  return Matrix3d::Identity() + std::sin(angle) * k + (1.0 - std::cos(angle)) * k * k;
}

}  // namespace

bool IsBenchShape(const std::string& shape) {
  constexpr std::array<std::string_view, 6> kNames = {"prism", "slab", "bipyramid",
                                                      "grid",  "mesh", kParallel};
  return EllipsoidAspect(shape) || std::find(kNames.begin(), kNames.end(), shape) != kNames.end();
}

Workload MakeRepeatWorkload(const WorkloadKey& key, int orientations) {
  Random random = Stream(key, "repeat");
  Workload workload;
  if (!AddBodies(key, 2, random, &workload)) return {};
  for (int i = 0; i < orientations; ++i) {
    const Course course = RandomCourse(key, random);
    AddLine(workload, 0, 1, course.rotation, course.direction);
  }
  return workload;
}

Workload MakeMixedWorkload(const WorkloadKey& key, int pairs, int vertices) {
  Random random = Stream(key, "mixed");
  Workload workload;
  const int count = std::max(kFewestMixedBodies, vertices / key.n);
  if (!AddBodies(key, count, random, &workload)) return {};
  for (int i = 0; i < pairs; ++i) {
    const int p = static_cast<int>(random.Below(count));
    const int q = static_cast<int>((p + 1 + random.Below(count - 1)) % count);
    const Course course = RandomCourse(key, random);
    AddLine(workload, p, q, course.rotation, course.direction);
  }
  return workload;
}

Workload MakeWarmWorkload(const WorkloadKey& key, int motions, int frames, double degrees) {
  Random random = Stream(key, "warm");
  Workload workload;
  if (!AddBodies(key, 2, random, &workload)) return {};
  for (int i = 0; i < motions; ++i) {
    const Course first = RandomCourse(key, random);
    const Vector3d axis = key.shape == kParallel ? Vector3d::UnitZ() : random.SpherePoint();
    for (int k = 0; k < frames; ++k) {
      AddLine(workload, 0, 1, RotationAbout(axis, k * degrees * (kPi / 180.0)) * first.rotation,
              first.direction);
    }
  }
  return workload;
}

std::vector<RelativePose> PlaceAtGap(const Workload& workload, double gap) {
  std::vector<RelativePose> poses;
  poses.reserve(workload.lines.size());
  for (const BenchLine& line : workload.lines) poses.push_back(PoseAtTravel(line.line, gap));
  return poses;
}

std::vector<Verdict> ExactVerdicts(const Workload& workload,
                                   const std::vector<RelativePose>& poses) {
  std::vector<Verdict> verdicts;
  verdicts.reserve(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const BenchLine& line = workload.lines[i];
    verdicts.push_back(
        exact::Decide(workload.exact_bodies[line.p], workload.exact_bodies[line.q], poses[i])
            .verdict);
  }
  return verdicts;
}

}  // namespace touchstone
