// SPDX-License-Identifier: MIT
#include "touchstone/tools/touchstone/body_arguments.h"

#include <ostream>

#include "touchstone/tools/bad_input.h"
#include "touchstone/tools/mesh_arguments.h"
#include "touchstone/tools/mesh_io.h"
#include "touchstone/tools/numbers.h"

namespace touchstone {
namespace {

ConvexPolyhedron Load(const std::string& path, bool hull) {
  Loaded<ConvexPolyhedron> body = ReadBody(path, hull);
  if (!body.ok()) throw BadInput{body.error()};
  return *body;
}

Json Describe(const std::string& file, const ConvexPolyhedron& body) {
  return {{"file", file}, {"vertices", body.vertex_count()}, {"faces", body.face_count()}};
}

}  // namespace

void AddBodyArguments(CLI::App* command, BodyArguments* arguments) {
  command->add_option("P", arguments->p, "mesh file of P: OFF, OBJ, STL or PLY")->required();
  command->add_option("Q", arguments->q, "mesh file of Q")->required();
  command
      ->add_option("--pose", arguments->pose,
                   "Q's placement relative to P: 12 numbers, row-major 3x4 [R | t]")
      ->expected(1, -1);
  command->add_option("--certainty", arguments->certainty, "float or exact")->capture_default_str();
  command->add_flag("--judge", arguments->judge, "check every part of the answer exactly");
  command->add_flag("--hull", arguments->hull, "take the convex hulls of the meshes");
  command->add_flag("--json", arguments->json, "print JSON");
}

PlacedPair LoadPair(const BodyArguments& arguments) {
  return {Load(arguments.p, arguments.hull), Load(arguments.q, arguments.hull),
          ParsePose(arguments.pose)};
}

Json DescribeBodies(const BodyArguments& arguments, const PlacedPair& pair) {
  return {{"p", Describe(arguments.p, pair.p)}, {"q", Describe(arguments.q, pair.q)}};
}

void PrintBodies(std::ostream& out, const BodyArguments& arguments, const PlacedPair& pair) {
  out << "P                " << arguments.p << ": " << pair.p.vertex_count() << " vertices, "
      << pair.p.face_count() << " faces\n"
      << "Q                " << arguments.q << ": " << pair.q.vertex_count() << " vertices, "
      << pair.q.face_count() << " faces\n";
}

void PrintFindings(std::ostream& out, const std::vector<NamedFinding>& findings, bool constructed) {
  if (findings.empty()) {
    out << "judge            no findings" << (constructed ? "; M was built whole, too" : "")
        << '\n';
  }
  for (const NamedFinding& finding : findings)
    out << "judge            " << finding.kind << ": " << finding.detail << '\n';
}

void PrintTimes(std::ostream& out, double query_ns, bool judged, double judge_ns) {
  out << "time             " << ShortDouble(query_ns) << " ns";
  if (judged) out << ", judge " << ShortDouble(judge_ns) << " ns";
  out << '\n';
}

}  // namespace touchstone
