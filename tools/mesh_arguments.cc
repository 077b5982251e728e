// SPDX-License-Identifier: MIT
#include "touchstone/tools/mesh_arguments.h"

#include "touchstone/tools/bad_input.h"
#include "touchstone/tools/mesh_io.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

constexpr std::string_view kShapePrefix = "shape:";
constexpr int kMaxShapeFaces = 10'000'000;

Shape ShapeOf(const std::string& word) {
  std::string name = word.substr(kShapePrefix.size());
  int face_count = 0;
  if (const auto colon = name.find(':'); colon != std::string::npos) {
    const auto number = ParseInteger<int>(name.substr(colon + 1));
    if (!number || *number < 4 || *number > kMaxShapeFaces) {
      throw BadInput{word + ": '" + name.substr(colon + 1) + "' is no number of faces"};
    }
    face_count = *number;
    name.resize(colon);
  }
  Shape shape = NamedShape(name, face_count);
  if (shape.faces.empty()) {
    std::string known;
    for (const std::string& each : ShapeNames()) known += ' ' + each;
    throw BadInput{word + ": unknown shape; known are" + known};
  }
  return shape;
}

Shape FileOf(const std::string& path) {
  const Loaded<PolygonSoup> soup = ReadPolygonSoup(path);
  if (!soup.ok()) throw BadInput{soup.error()};
  Shape shape;
  shape.vertices = soup->points;
  for (const std::vector<int>& loop : soup->polygons) {
    for (std::size_t k = 2; k < loop.size(); ++k) {
      shape.AddTriangle(loop[0], loop[k - 1], loop[k]);
    }
  }
  return shape;
}

}  // namespace

TriangleMesh LoadMesh(const std::string& word) {
  const Shape shape = word.starts_with(kShapePrefix) ? ShapeOf(word) : FileOf(word);
  const StatusOr<TriangleMesh> mesh = TriangleMesh::Build(shape.vertices, shape.faces);
  if (!mesh.ok()) throw BadInput{word + ": " + mesh.status().ToString()};
  return *mesh;
}

RelativePose ParsePose(const std::vector<std::string>& words) {
  if (words.empty()) return RelativePose();
  if (words.size() != 12) {
    throw BadInput{"--pose: takes 12 numbers, the rows of [R | t], not " +
                   std::to_string(words.size())};
  }
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  for (int k = 0; k < 12; ++k) {
    const auto number = ParseDouble(words[k]);
    if (!number) throw BadInput{"--pose: '" + words[k] + "' is not a number"};
    (k % 4 == 3 ? translation[k / 4] : rotation(k / 4, k % 4)) = *number;
  }
  StatusOr<RelativePose> pose = RelativePose::Make(rotation, translation);
  if (!pose.ok()) throw BadInput{"--pose: " + pose.status().ToString()};
  return *pose;
}

}  // namespace touchstone
