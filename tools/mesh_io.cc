// SPDX-License-Identifier: MIT
//
// The one place that uses CGAL's readers. They report failure by a false, so the position of the
// stream tells where they stopped; they trust counts in the file, so memory is limited while they
// run.
#include "touchstone/tools/mesh_io.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>
#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <new>
#include <sstream>
#include <utility>

#include "touchstone/exact/convex_hull.h"

namespace touchstone {
namespace {

using CgalPoint = CGAL::Simple_cartesian<double>::Point_3;
using CgalPoints = std::vector<CgalPoint>;
using CgalPolygons = std::vector<std::vector<std::size_t>>;

// A file of 20 bytes may announce 10^9 vertices. Bodies take some hundred bytes a byte of file at
// most.
constexpr rlim_t kMemoryForReading = rlim_t{1} << 32;

// Address sanitizers reserve terabytes and cannot run under the limit.
#ifdef TOUCHSTONE_SANITIZED
constexpr bool kLimitMemory = false;
#else
constexpr bool kLimitMemory = true;
#endif

class MemoryLimit {
 public:
  MemoryLimit() {
    if (!kLimitMemory || getrlimit(RLIMIT_AS, &before_) != 0) return;
    rlimit limited = before_;
    limited.rlim_cur = std::min(before_.rlim_max, kMemoryForReading);
    active_ = limited.rlim_cur < before_.rlim_cur && setrlimit(RLIMIT_AS, &limited) == 0;
  }
  ~MemoryLimit() {
    if (active_) setrlimit(RLIMIT_AS, &before_);
  }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
  bool active_ = false;
};

// What others write to std::cerr goes to a buffer while this lives.
class QuietCerr {
 public:
  QuietCerr() : before_(std::cerr.rdbuf(buffer_.rdbuf())) {}
  ~QuietCerr() { std::cerr.rdbuf(before_); }
  QuietCerr(const QuietCerr&) = delete;
  QuietCerr& operator=(const QuietCerr&) = delete;

 private:
  std::ostringstream buffer_;
  std::streambuf* before_;
};

std::string LowerExtension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

bool CallReader(const std::string& extension, std::istream& in, CgalPoints& points,
                CgalPolygons& polygons) {
  const auto quiet = CGAL::parameters::verbose(false);
  if (extension == ".off") return CGAL::IO::read_OFF(in, points, polygons, quiet);
  if (extension == ".obj") return CGAL::IO::read_OBJ(in, points, polygons, quiet);
  if (extension == ".stl") return CGAL::IO::read_STL(in, points, polygons, quiet);
  return CGAL::IO::read_PLY(in, points, polygons, quiet);
}

// What is wrong with the header of a PLY file, ": line 3: ...", or nothing. CGAL's reader skips
// words that it does not know, and takes a property for one of an element that is not there.
std::string PlyHeaderError(const std::string& content) {
  std::istringstream in(content);
  std::string line;
  bool has_element = false;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string keyword, name, count;
    words >> keyword;
    const auto fail = [&](const std::string& what) {
      return ": line " + std::to_string(number) + ": " + what;
    };
    if (number == 1) {
      if (keyword != "ply") return fail("does not begin with ply");
    } else if (keyword == "end_header") {
      return "";
    } else if (keyword == "element") {
      words >> name >> count;
      if (count.empty() || count.size() > 18 ||
          count.find_first_not_of("0123456789") != std::string::npos) {
        return fail("an element needs a name and a count");
      }
      has_element = true;
    } else if (keyword == "property") {
      if (!has_element) return fail("a property of no element");
    } else if (keyword != "format" && keyword != "comment" && keyword != "obj_info") {
      return fail("a header has no such line");
    }
  }
  return ": the header has no end";
}

// ": line 7: ..." for text, ": byte 84: ..." for what does not look like text.
std::string Where(const std::string& content, std::istream& in) {
  in.clear();
  const auto told = in.tellg();
  const std::size_t position =
      told < 0 ? content.size() : std::min(content.size(), static_cast<std::size_t>(told));
  const bool at_end = position >= content.size();
  if (content.find('\0') != std::string::npos) {
    return ": byte " + std::to_string(position) + (at_end ? " (end of file)" : "");
  }
  const auto newlines =
      std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(position), '\n');
  const bool line_done = position > 0 && content[position - 1] == '\n';
  return ": line " + std::to_string(std::max<std::ptrdiff_t>(1, newlines + (line_done ? 0 : 1))) +
         (at_end ? " (end of file)" : "");
}

Loaded<PolygonSoup> ToSoup(const std::string& path, const CgalPoints& points,
                           const CgalPolygons& polygons) {
  using Result = Loaded<PolygonSoup>;
  PolygonSoup soup;
  for (const CgalPoint& point : points) soup.points.emplace_back(point.x(), point.y(), point.z());
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    std::vector<int> loop;
    for (const std::size_t v : polygons[f]) {
      if (v >= points.size()) {
        return Result::Error(path + ": face " + std::to_string(f) +
                             " names a vertex that does not exist (there are " +
                             std::to_string(points.size()) + ")");
      }
      loop.push_back(static_cast<int>(v));
    }
    soup.polygons.push_back(std::move(loop));
  }
  return soup;
}

void MergeEqualPoints(PolygonSoup& soup) {
  std::map<std::array<double, 3>, int> index_of;
  std::vector<int> merged;
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& x : soup.points) {
    // NaN would break the order; the builder refuses it by name.
    if (x.hasNaN()) return;
    const auto [entry, fresh] =
        index_of.try_emplace({x[0], x[1], x[2]}, static_cast<int>(points.size()));
    if (fresh) points.push_back(x);
    merged.push_back(entry->second);
  }
  soup.points = std::move(points);
  for (std::vector<int>& loop : soup.polygons) {
    for (int& v : loop) v = merged[v];
  }
}

}  // namespace

bool PolygonSoup::IsClosed() const {
  std::map<std::pair<int, int>, int> sides;
  for (const std::vector<int>& loop : polygons) {
    for (std::size_t k = 0; k < loop.size(); ++k) ++sides[{loop[k], loop[(k + 1) % loop.size()]}];
  }
  return !sides.empty() && std::all_of(sides.begin(), sides.end(), [&](const auto& side) {
    const auto opposite = sides.find({side.first.second, side.first.first});
    return side.second == 1 && opposite != sides.end();
  });
}

Loaded<PolygonSoup> ReadPolygonSoup(const std::string& path) {
  using Result = Loaded<PolygonSoup>;
  const std::string extension = LowerExtension(path);
  if (extension != ".off" && extension != ".obj" && extension != ".stl" && extension != ".ply") {
    return Result::Error(path + ": unknown kind of file; known are .off, .obj, .stl and .ply");
  }
  std::error_code status;
  if (std::filesystem::is_directory(path, status)) return Result::Error(path + ": is a directory");
  std::ifstream file(path, std::ios::binary);
  if (!file) return Result::Error(path + ": cannot be opened");
  std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (content.empty()) return Result::Error(path + ": the file is empty");

  if (extension == ".ply") {
    const std::string error = PlyHeaderError(content);
    if (!error.empty()) return Result::Error(path + error);
  }

  CgalPoints points;
  CgalPolygons polygons;
  std::istringstream in(content);
  in.imbue(std::locale::classic());
  std::string reason;
  try {
    const QuietCerr quiet;
    const MemoryLimit limit;
    if (!CallReader(extension, in, points, polygons)) {
      reason = "cannot be read from here as " + extension.substr(1);
    }
  } catch (const std::bad_alloc&) {
    reason = "announces more elements than memory holds";
  } catch (const std::length_error&) {
    reason = "announces more elements than memory holds";
  } catch (const std::exception&) {
    reason = "cannot be read from here as " + extension.substr(1);
  }
  if (!reason.empty()) return Result::Error(path + Where(content, in) + ": " + reason);
  if (points.empty()) return Result::Error(path + ": holds no vertices");
  Result soup = ToSoup(path, points, polygons);
  if (!soup.ok() || extension != ".stl") return soup;
  PolygonSoup merged = *soup;
  MergeEqualPoints(merged);
  return merged;
}

Loaded<ConvexPolyhedron> ReadBody(const std::string& path, bool hull) {
  using Result = Loaded<ConvexPolyhedron>;
  const Loaded<PolygonSoup> soup = ReadPolygonSoup(path);
  if (!soup.ok()) return Result::Error(soup.error());
  const StatusOr<ConvexPolyhedron> body =
      hull ? exact::ConvexHull(soup->points)
           : ConvexPolyhedron::Build(soup->points, soup->polygons);
  if (body.ok()) return *body;
  return Result::Error(path + ": " + body.status().ToString() +
                       (hull ? "" : " (--hull takes the convex hull)"));
}

}  // namespace touchstone
