// SPDX-License-Identifier: MIT
#include "touchstone/tools/scene/scene_file.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <tuple>

#include "touchstone/tools/bad_input.h"
#include "touchstone/tools/mesh_arguments.h"
#include "touchstone/tools/mesh_io.h"
#include "touchstone/tools/shapes/shapes.h"
#include "touchstone/tools/suites/random.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kMaxCount = 1'000'000;
constexpr double kLeastLength = 1e-90, kLargestLength = 1e90;

// A value of the file and where it stands; what it throws says so.
class Element {
 public:
  Element(const Json& json, std::string path) : json_(json), path_(std::move(path)) {}

  [[noreturn]] void Fail(const std::string& what) const {
    throw BadInput{path_ + (path_.ends_with(": ") ? "" : ": ") + what};
  }

  bool Has(const char* key) const { return json_.is_object() && json_.contains(key); }
  Element At(const char* key) const {
    if (!json_.is_object()) Fail("is no object");
    if (!json_.contains(key)) Fail(std::string("lacks '") + key + "'");
    return {json_.at(key), path_ + (path_.ends_with(": ") ? "" : ".") + key};
  }
  std::size_t size() const {
    if (!json_.is_array()) Fail("is no list");
    return json_.size();
  }
  Element operator[](std::size_t i) const {
    return {json_.at(i), path_ + "[" + std::to_string(i) + "]"};
  }
  // Every key must be one of these: a misspelt one would go unnoticed.
  void CheckKeys(std::initializer_list<const char*> known) const {
    if (!json_.is_object()) Fail("is no object");
    for (const auto& [key, value] : json_.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        Fail("has an unknown key '" + key + "'");
      }
    }
  }

  double Number() const {
    if (!json_.is_number() || !std::isfinite(json_.get<double>())) Fail("is no finite number");
    return json_.get<double>();
  }
  int Count(int least, int most) const {
    if (!json_.is_number_integer()) Fail("is no integer");
    const auto value = json_.get<long long>();
    if (value < least || value > most) {
      Fail("is not within " + std::to_string(least) + " to " + std::to_string(most));
    }
    return static_cast<int>(value);
  }
  std::uint32_t Bits() const {
    if (!json_.is_number_unsigned() || json_.get<std::uint64_t>() > 0xffffffffu) {
      Fail("is no number of 32 bits");
    }
    return json_.get<std::uint32_t>();
  }
  bool Flag() const {
    if (!json_.is_boolean()) Fail("is neither true nor false");
    return json_.get<bool>();
  }
  std::string Word() const {
    if (!json_.is_string()) Fail("is no string");
    return json_.get<std::string>();
  }
  Vector3d Vector() const {
    if (!json_.is_array() || json_.size() != 3) Fail("is no list of 3 numbers");
    return {(*this)[0].Number(), (*this)[1].Number(), (*this)[2].Number()};
  }
  // Of lengths that bodies may have.
  Vector3d Lengths() const {
    const Vector3d lengths = Vector();
    if (!(lengths.minCoeff() >= kLeastLength && lengths.maxCoeff() <= kLargestLength)) {
      Fail("has a length that is not within 1e-90 to 1e90");
    }
    return lengths;
  }

  const Json& json() const { return json_; }
  const std::string& path() const { return path_; }

 private:
  const Json& json_;
  std::string path_;
};

Matrix3d Turn(const Vector3d& axis_times_angle) {
  const double angle = axis_times_angle.norm();
  if (angle == 0.0) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, axis_times_angle / angle).toRotationMatrix();
}

class Parser {
 public:
  Parser(const Json& json, const std::string& source)
      : root_(json, source + ": "), folder_(std::filesystem::path(source).parent_path()) {}

  SceneSpec Run() {
    root_.CheckKeys({"shapes", "bodies", "pairs", "ignore", "steps", "recorded", "comment"});
    const Element shapes = root_.At("shapes");
    if (!shapes.json().is_object()) shapes.Fail("is no object");
    for (const auto& [name, value] : shapes.json().items()) {
      shapes_.emplace(name, ParseShape({value, shapes.path() + "." + name}));
    }
    const Element bodies = root_.At("bodies");
    for (std::size_t i = 0; i < bodies.size(); ++i) AddBody(bodies[i]);
    if (root_.Has("pairs")) {
      const Element pairs = root_.At("pairs");
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i].CheckKeys({"bodies", "subscriptions"});
        const auto [a, b] = ParsePair(pairs[i].At("bodies"));
        spec_.pairs.emplace_back(a, b, ParseSubscriptions(pairs[i].At("subscriptions")));
      }
    }
    if (root_.Has("ignore")) {
      const Element ignored = root_.At("ignore");
      for (std::size_t i = 0; i < ignored.size(); ++i) {
        spec_.ignored.push_back(ParsePair(ignored[i]));
      }
    }
    if (root_.Has("steps")) spec_.steps = root_.At("steps").Count(0, kMaxCount);
    if (root_.Has("recorded")) ParseRecord(root_.At("recorded"));
    return std::move(spec_);
  }

 private:
  std::string PathOf(const Element& file) const {
    const std::filesystem::path path(file.Word());
    return path.is_absolute() ? path.string() : (folder_ / path).string();
  }

  // What other parts of the program say of bad data, said of the element.
  template <class Make>
  static auto Named(const Element& element, Make make) {
    try {
      return make();
    } catch (const BadInput& bad) {
      element.Fail(bad.message);
    }
  }

  ConvexPolyhedron ParseConvex(const Element& shape) {
    if (shape.Has("box")) {
      shape.CheckKeys({"box", "at"});
      const Vector3d half = shape.At("box").Lengths();
      const Vector3d at = shape.Has("at") ? shape.At("at").Vector() : Vector3d(Vector3d::Zero());
      std::vector<Vector3d> corners;
      for (int k = 0; k < 8; ++k) {
        corners.push_back(at + Vector3d(k & 1 ? half[0] : -half[0], k & 2 ? half[1] : -half[1],
                                        k & 4 ? half[2] : -half[2]));
      }
      const auto body = HullBody(corners, FacetStyle::kMerged);
      if (!body.ok()) shape.Fail(body.status().ToString());
      return *body;
    }
    if (shape.Has("hull")) {
      shape.CheckKeys({"hull"});
      const Element hull = shape.At("hull");
      hull.CheckKeys({"vertices", "semi_axes", "seed"});
      const int count = hull.At("vertices").Count(4, 100000);
      const Vector3d axes =
          hull.Has("semi_axes") ? hull.At("semi_axes").Lengths() : Vector3d(1, 1, 1);
      if (axes.maxCoeff() > 1e6 * axes.minCoeff()) {
        hull.At("semi_axes").Fail("is flatter than a millionth");
      }
      Random random(
          "scene hull",
          hull.Has("seed") ? static_cast<std::uint64_t>(hull.At("seed").Count(0, kMaxCount)) : 1,
          static_cast<std::uint64_t>(count));
      return EllipsoidBody(random, count, axes);
    }
    if (shape.Has("points")) {
      shape.CheckKeys({"points"});
      std::vector<Vector3d> points;
      const Element list = shape.At("points");
      for (std::size_t i = 0; i < list.size(); ++i) points.push_back(list[i].Vector());
      const auto body = HullBody(points, FacetStyle::kMerged);
      if (!body.ok()) list.Fail(body.status().ToString());
      return *body;
    }
    if (shape.Has("file")) {
      shape.CheckKeys({"file", "hull"});
      const auto body =
          ReadBody(PathOf(shape.At("file")), shape.Has("hull") && shape.At("hull").Flag());
      if (!body.ok()) shape.At("file").Fail(body.error());
      return *body;
    }
    shape.Fail("is no convex shape: give 'box', 'hull', 'points' or 'file'");
  }

  TriangleMesh ParseMesh(const Element& shape) {
    shape.CheckKeys({"mesh", "faces", "scale"});
    const Element mesh = shape.At("mesh");
    const std::string name = mesh.Word();
    const double scale = shape.Has("scale") ? shape.At("scale").Number() : 1.0;
    const int faces = shape.Has("faces") ? shape.At("faces").Count(4, 10'000'000) : 0;
    Shape made = NamedShape(name, faces);
    if (made.faces.empty()) {
      const std::string path = PathOf(mesh);
      if (!std::filesystem::exists(path)) {
        mesh.Fail("is neither a shape's name nor a file: '" + name + "'");
      }
      const TriangleMesh loaded = Named(mesh, [&] { return LoadMesh(path); });
      made.vertices.assign(loaded.vertices().begin(), loaded.vertices().end());
      made.faces.assign(loaded.faces().begin(), loaded.faces().end());
    }
    made = Moved(std::move(made), scale, Vector3d::Zero());
    const auto built = TriangleMesh::Build(made.vertices, made.faces);
    if (!built.ok()) shape.Fail(built.status().ToString());
    return *built;
  }

  SceneShape ParseShape(const Element& shape) {
    if (shape.Has("mesh")) return SceneShape::Mesh(ParseMesh(shape));
    if (!shape.Has("compound")) return SceneShape::Convex(ParseConvex(shape));
    shape.CheckKeys({"compound"});
    std::vector<ConvexPolyhedron> parts;
    const Element list = shape.At("compound");
    for (std::size_t i = 0; i < list.size(); ++i) parts.push_back(ParseConvex(list[i]));
    const auto compound = SceneShape::Compound(parts);
    if (!compound.ok()) list.Fail(compound.status().ToString());
    return *compound;
  }

  static Subscriptions ParseSubscriptions(const Element& element) {
    element.CheckKeys({"verdict", "distance", "depth", "cpd", "travel"});
    Subscriptions wanted;
    if (element.Has("verdict")) wanted.verdict = element.At("verdict").Flag();
    if (element.Has("distance")) wanted.distance = element.At("distance").Number();
    if (element.Has("depth")) wanted.depth = element.At("depth").Flag();
    if (element.Has("cpd")) wanted.cpd = element.At("cpd").Flag();
    if (element.Has("travel")) {
      const Element travel = element.At("travel");
      travel.CheckKeys({"direction", "reach"});
      wanted.travel =
          Subscriptions::Travel{travel.At("direction").Vector(), travel.At("reach").Number()};
    }
    return wanted;
  }

  BodyMotion ParseMotion(const Element& element) const {
    element.CheckKeys({"velocity", "spin", "within", "hinge", "parent"});
    BodyMotion motion;
    if (element.Has("velocity")) motion.velocity = element.At("velocity").Vector();
    if (element.Has("spin")) motion.spin = element.At("spin").Vector();
    if (element.Has("within")) {
      motion.within = element.At("within").Vector();
      if (!(motion.within->minCoeff() > 0.0)) element.At("within").Fail("is not positive");
    }
    if (element.Has("hinge")) {
      const Element hinge = element.At("hinge");
      hinge.CheckKeys({"point", "axis", "amplitude", "period"});
      motion.hinge = BodyMotion::Hinge{hinge.At("point").Vector(), hinge.At("axis").Vector(),
                                       hinge.At("amplitude").Number(), hinge.At("period").Number()};
      if (!(motion.hinge->axis.norm() > 1e-9)) hinge.At("axis").Fail("has no length");
      if (!(motion.hinge->period > 0.0)) hinge.At("period").Fail("is not positive");
    }
    if (element.Has("parent")) motion.parent = BodyIndex(element.At("parent"));
    return motion;
  }

  void AddBody(const Element& element) {
    element.CheckKeys({"name", "shape", "position", "rotation", "turn", "motion", "subscriptions",
                       "group", "mask"});
    const std::string shape = element.At("shape").Word();
    const auto found = shapes_.find(shape);
    if (found == shapes_.end()) element.At("shape").Fail("there is no shape '" + shape + "'");
    const std::size_t index = spec_.bodies.size();
    SceneBodySpec body{"body " + std::to_string(index), found->second, {}, {}, {}, {}};
    if (element.Has("name")) body.name = element.At("name").Word();
    if (numbers_.contains(body.name)) {
      element.Fail("there is another '" + body.name + "' before it");
    }
    if (element.Has("position")) body.pose.translation = element.At("position").Vector();
    if (element.Has("turn")) body.pose.rotation = Turn(element.At("turn").Vector());
    if (element.Has("rotation")) {
      const Element rotation = element.At("rotation");
      if (rotation.size() != 9) rotation.Fail("is no list of 9 numbers");
      for (std::size_t k = 0; k < 9; ++k) {
        body.pose.rotation(static_cast<int>(k) / 3, static_cast<int>(k) % 3) = rotation[k].Number();
      }
    }
    if (element.Has("motion")) body.motion = ParseMotion(element.At("motion"));
    if (element.Has("subscriptions")) {
      body.subscriptions = ParseSubscriptions(element.At("subscriptions"));
    }
    if (element.Has("group")) body.filter.group = element.At("group").Bits();
    if (element.Has("mask")) body.filter.mask = element.At("mask").Bits();
    // Whatever the scene itself would refuse is refused here, where the element is known.
    Scene trial;
    const auto added = trial.Add(body.shape, body.pose, body.subscriptions);
    if (!added.ok()) element.Fail(added.status().ToString());
    numbers_.emplace(body.name, static_cast<int>(index));
    spec_.bodies.push_back(std::move(body));
  }

  int BodyIndex(const Element& element) const {
    if (element.json().is_string()) {
      const std::string name = element.Word();
      const auto found = numbers_.find(name);
      if (found != numbers_.end()) return found->second;
      element.Fail("there is no body '" + name + "' before it");
    }
    return element.Count(0, static_cast<int>(spec_.bodies.size()) - 1);
  }

  std::pair<int, int> ParsePair(const Element& element) const {
    if (element.size() != 2) element.Fail("is no list of 2 bodies");
    const int a = BodyIndex(element[0]), b = BodyIndex(element[1]);
    if (a == b) element.Fail("names one body twice");
    return {a, b};
  }

  void ParseRecord(const Element& element) {
    element.CheckKeys({"poses", "events"});
    const Element steps = element.At("poses"), events = element.At("events");
    if (steps.size() != events.size()) element.Fail("has poses and events of different lengths");
    for (std::size_t s = 0; s < steps.size(); ++s) {
      if (steps[s].size() != spec_.bodies.size())
        steps[s].Fail("does not hold a pose for each body");
      auto& poses = spec_.recorded_poses.emplace_back();
      for (std::size_t i = 0; i < steps[s].size(); ++i) {
        const Element numbers = steps[s][i];
        if (numbers.size() != 12) numbers.Fail("is no list of 12 numbers, the rows of [R | t]");
        WorldPose& pose = poses.emplace_back();
        for (int k = 0; k < 12; ++k) {
          (k % 4 == 3 ? pose.translation[k / 4] : pose.rotation(k / 4, k % 4)) =
              numbers[k].Number();
        }
      }
      auto& told = spec_.recorded_events.emplace_back();
      for (std::size_t k = 0; k < events[s].size(); ++k) told.push_back(events[s][k].Word());
    }
    spec_.steps = static_cast<int>(spec_.recorded_poses.size());
  }

  Element root_;
  std::filesystem::path folder_;
  std::map<std::string, SceneShape> shapes_;
  std::map<std::string, int> numbers_;  // of the bodies, by name
  SceneSpec spec_;
};

// x reflected at the ends of [-half, half].
double Reflected(double x, double half) {
  const double period = 4.0 * half;
  double phase = std::fmod(x + half, period);
  if (phase < 0.0) phase += period;
  return phase <= 2.0 * half ? phase - half : 3.0 * half - phase;
}

}  // namespace

Json ReadSceneJson(const std::string& path) {
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path)) throw BadInput{path + ": cannot be read"};
  try {
    return Json::parse(in);
  } catch (const Json::parse_error& error) {
    throw BadInput{path + ": byte " + std::to_string(error.byte) + ": is no JSON"};
  } catch (const Json::exception& error) {
    throw BadInput{path + ": " + error.what()};
  }
}

SceneSpec ParseScene(const Json& json, const std::string& source) {
  return Parser(json, source).Run();
}

std::vector<WorldPose> PosesAt(const SceneSpec& spec, int step) {
  if (!spec.recorded_poses.empty()) return spec.recorded_poses[std::max(0, step - 1)];
  std::vector<WorldPose> poses;
  for (const SceneBodySpec& body : spec.bodies) {
    const BodyMotion& motion = body.motion;
    WorldPose pose = body.pose;
    if (step > 0) {
      pose.translation += step * motion.velocity;
      if (motion.within) {
        for (int i = 0; i < 3; ++i) {
          pose.translation[i] = Reflected(pose.translation[i], (*motion.within)[i]);
        }
      }
      if (!motion.spin.isZero(0.0)) pose.rotation = Turn(step * motion.spin) * pose.rotation;
    }
    if (motion.hinge) {
      const BodyMotion::Hinge& hinge = *motion.hinge;
      const double angle = hinge.amplitude * std::sin(2.0 * std::numbers::pi * step / hinge.period);
      const Matrix3d turn = Turn(angle * hinge.axis.normalized());
      pose.rotation = turn * pose.rotation;
      pose.translation = turn * (pose.translation - hinge.point) + hinge.point;
    }
    if (motion.parent) {
      const WorldPose& parent = poses[*motion.parent];
      pose.translation = parent.rotation * pose.translation + parent.translation;
      pose.rotation = parent.rotation * pose.rotation;
    }
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace touchstone
