// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "touchstone/exact/convex_hull.h"
#include "touchstone/tools/mesh_io.h"
#include "touchstone/tools/suites/arithmetic.h"
#include "touchstone/tools/suites/placement.h"
#include "touchstone/tools/suites/random.h"
#include "touchstone/tools/suites/recent_cache.h"
#include "touchstone/tools/suites/registry.h"

namespace touchstone {
namespace {

// Hulls with more corners are left out: they would take the whole time.
constexpr int kMaxCorners = 2000;

struct Block {
  ConvexPolyhedron p, q;
  ContactLine line;
};

// The hulls of the closed meshes in a folder, in the order of the file names.
std::vector<ConvexPolyhedron> LoadHulls(const std::string& directory) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(directory, error)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".off" || extension == ".obj" || extension == ".stl" || extension == ".ply") {
      paths.push_back(entry.path().string());
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<ConvexPolyhedron> hulls;
  for (const std::string& path : paths) {
    const Loaded<PolygonSoup> soup = ReadPolygonSoup(path);
    if (!soup.ok() || !soup->IsClosed()) continue;
    // Facets of several triangles are polygons in every other hull.
    const bool merge = hulls.size() % 2 == 0;
    StatusOr<ConvexPolyhedron> hull = exact::ConvexHull(soup->points, {.merge_coplanar = merge});
    if (hull.ok() && hull->vertex_count() <= kMaxCorners) hulls.push_back(*hull);
  }
  return hulls;
}

class MeshesSuite : public Suite {
 public:
  explicit MeshesSuite(const std::string& directory) : directory_(directory) {
    if (!directory.empty()) hulls_ = LoadHulls(directory);
  }

  std::string_view name() const override { return "meshes"; }
  std::string_view summary() const override {
    return "hulls of the closed meshes in --meshes DIR, random rotations, deep to far and near "
           "contact";
  }
  std::string_view attacks() const override {
    return "real coordinates: uneven sampling, slivers, nearly coplanar facets, any scale and "
           "offset";
  }
  std::string unavailable() const override {
    if (directory_.empty()) return "no folder of meshes given (--meshes DIR)";
    if (hulls_.empty()) return "no closed mesh in " + directory_;
    return {};
  }

  // Depends on the files in the folder as well.
  PlacedPair Generate(std::uint64_t seed, std::uint64_t index) const override {
    thread_local RecentCache<Block> cache;
    const Block& block = cache.Get(directory_, seed, index / kPlacementCount, [&] {
      Random random(name(), seed, index / kPlacementCount);
      const std::span<const ConvexPolyhedron> hulls(hulls_);
      const ConvexPolyhedron& p = random.Pick(hulls);
      const ConvexPolyhedron& q = random.OneIn(4) ? p : random.Pick(hulls);
      const Eigen::Matrix3d rotation = random.Rotation();
      return Block{p, q, FindContactLine(p, q, rotation, random.SpherePoint())};
    });
    return {block.p, block.q,
            PoseOfPlacement(block.line, static_cast<int>(index % kPlacementCount))};
  }

 private:
  std::string directory_;
  std::vector<ConvexPolyhedron> hulls_;
};

}  // namespace

std::unique_ptr<Suite> MakeMeshesSuite(const std::string& meshes_dir) {
  return std::make_unique<MeshesSuite>(meshes_dir);
}

}  // namespace touchstone
