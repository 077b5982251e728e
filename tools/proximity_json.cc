// SPDX-License-Identifier: MIT
#include "touchstone/tools/proximity_json.h"

#include <algorithm>
#include <ostream>
#include <span>

#include "touchstone/tools/numbers.h"

namespace touchstone {
namespace {

Json PairsToJson(std::span<const VertexPair> pairs) {
  Json json = Json::array();
  for (const VertexPair& pair : pairs) json.push_back({pair.p, pair.q});
  return json;
}

std::string PairsText(std::span<const VertexPair> pairs) {
  std::string text;
  for (const VertexPair& pair : pairs) {
    text += (text.empty() ? "(p" : " (p") + std::to_string(pair.p) + " - q" +
            std::to_string(pair.q) + ")";
  }
  return text;
}

Json FacetToJson(const ContactFacet& facet) {
  return {{"class", ToString(facet.face_class)},
          {"feature_p", ToJson(facet.feature_p)},
          {"feature_q", ToJson(facet.feature_q)},
          {"triangle", ToJson(facet.triangle)}};
}

std::string FacetText(const ContactFacet& facet) {
  return std::string(ToString(facet.face_class)) + ": " + Text(facet.feature_p) + " of P, " +
         Text(facet.feature_q) + " of Q, through " + Text(facet.triangle);
}

Json CountsToJson(const PhaseCounts& counts, long exact_signs) {
  return {{"rounds", counts.faces_visited},
          {"support_calls", counts.support_calls},
          {"climb_steps", counts.climb_steps},
          {"exact_signs", exact_signs}};
}

void PrintCounts(std::ostream& out, Tier tier, const PhaseCounts& counts, long exact_signs) {
  out << "decided          by " << ToString(tier) << ", " << counts.support_calls
      << " support pairs, " << exact_signs << " exact signs\n";
}

Json EndToJson(const TravelEnd& end) {
  Json json = {{"travel", ToJson(end.travel)}};
  if (end.facet) json["facet"] = FacetToJson(*end.facet);
  return json;
}

void PrintEnd(std::ostream& out, const char* name, const TravelEnd& end) {
  out << name << Text(end.travel);
  if (end.facet) out << ", by " << FacetText(*end.facet);
  out << "\n";
}

}  // namespace

Json ToJson(const DistanceResult& result) {
  Json json = {{"kind", ToString(result.kind)},
               {"tier", ToString(result.tier)},
               {"distance", ToJson(result.distance)},
               {"lower", result.lower},
               {"upper", result.upper}};
  if (result.kind == DistanceKind::kSeparate) {
    json["point_on_p"] = ToJson(result.point_on_p);
    json["point_on_q"] = ToJson(result.point_on_q);
    json["point_error"] = result.point_error;
    json["direction"] = ToJson(result.direction);
    json["optimal"] = result.optimal;
    json["simplex"] = PairsToJson(std::span(result.simplex).first(result.simplex_size));
    if (result.feature_p) json["feature_p"] = ToJson(*result.feature_p);
    if (result.feature_q) json["feature_q"] = ToJson(*result.feature_q);
  } else if (result.kind == DistanceKind::kMeet) {
    json["certificate"] = ToJson(result.certificate);
    json["interior_p"] = result.interior_p;
    json["interior_q"] = result.interior_q;
  }
  json["counts"] = CountsToJson(result.counts, result.exact_signs);
  return json;
}

Json ToJson(const PenetrationResult& result) {
  Json json = {{"verdict", ToString(result.verdict)},
               {"tier", ToString(result.tier)},
               {"depth", ToJson(result.depth)},
               {"lower", result.lower},
               {"upper", result.upper}};
  if (result.verdict == Verdict::kOverlap) {
    json["translation"] = ToJson(result.translation);
    json["translation_error"] = result.foot_error;
    json["direction"] = ToJson(result.direction);
    json["minimal"] = result.minimal;
    json["point_on_p"] = ToJson(result.point_on_p);
    json["point_on_q"] = ToJson(result.point_on_q);
    json["point_error"] = result.point_error;
  }
  if (result.facet) json["facet"] = FacetToJson(*result.facet);
  if (!result.inner_polytope.empty()) {
    json["inner_polytope"] = Json::array();
    for (const auto& triangle : result.inner_polytope)
      json["inner_polytope"].push_back(ToJson(triangle));
  }
  if (result.verdict != Verdict::kOverlap) json["certificate"] = ToJson(result.certificate);
  json["interior_p"] = result.interior_p;
  json["interior_q"] = result.interior_q;
  json["counts"] = CountsToJson(result.counts, result.exact_signs);
  return json;
}

Json ToJson(const DirectionalResult& result) {
  Json json = {{"kind", ToString(result.kind)}, {"tier", ToString(result.tier)}};
  if (result.kind == TravelKind::kInterval) {
    json["enter"] = EndToJson(result.enter);
    json["leave"] = EndToJson(result.leave);
    json["grazing"] = result.grazing;
  } else if (result.kind == TravelKind::kNever) {
    json["separator"] = PairsToJson(result.separator);
  }
  json["counts"] = CountsToJson(result.counts, result.exact_signs);
  return json;
}

Json ToJson(const PublishedTravel& result) {
  Json json = {{"kind", ToString(result.kind)}};
  if (result.kind == PublishedTravelKind::kNever) return json;
  json["corners"] = ToJson(result.corners);
  json["weights"] = result.weights;
  json["c_travel"] = result.c_travel;
  if (result.kind == PublishedTravelKind::kTravel) {
    json["travel"] = result.travel;
    json["face"] = {{"class", ToString(result.face_class)},
                    {"feature_p", ToJson(result.feature_p)},
                    {"feature_q", ToJson(result.feature_q)}};
  }
  return json;
}

void PrintResult(std::ostream& out, const DistanceResult& result) {
  out << "kind             " << ToString(result.kind) << "\n"
      << "distance         " << Text(result.distance) << ", from " << ShortDouble(result.lower)
      << " to " << ShortDouble(result.upper) << "\n";
  if (result.kind == DistanceKind::kSeparate) {
    out << "closest points   " << Text(result.point_on_p) << " of P, " << Text(result.point_on_q)
        << " of Q, +- " << ShortDouble(result.point_error) << "\n"
        << "direction        " << Text(result.direction) << "\n"
        << "simplex          " << PairsText(std::span(result.simplex).first(result.simplex_size))
        << (result.optimal ? ", proven nearest" : "") << "\n";
    if (result.feature_p && result.feature_q) {
      out << "features         " << Text(*result.feature_p) << " of P, " << Text(*result.feature_q)
          << " of Q\n";
    }
  } else if (result.kind == DistanceKind::kMeet) {
    PrintCertificate(out, result.certificate);
  }
  PrintCounts(out, result.tier, result.counts, result.exact_signs);
}

void PrintResult(std::ostream& out, const PenetrationResult& result) {
  out << "verdict          " << ToString(result.verdict) << "\n"
      << "depth            " << Text(result.depth) << ", from " << ShortDouble(result.lower)
      << " to " << ShortDouble(result.upper) << "\n";
  if (result.verdict == Verdict::kOverlap) {
    out << "translation      " << Text(result.translation) << " of Q, +- "
        << ShortDouble(result.foot_error) << (result.minimal ? ", proven least" : "") << "\n"
        << "deepest points   " << Text(result.point_on_p) << " of P, " << Text(result.point_on_q)
        << " of Q, +- " << ShortDouble(result.point_error) << "\n";
  }
  if (result.facet) out << "facet            " << FacetText(*result.facet) << "\n";
  if (result.verdict != Verdict::kOverlap) PrintCertificate(out, result.certificate);
  PrintCounts(out, result.tier, result.counts, result.exact_signs);
}

void PrintResult(std::ostream& out, const DirectionalResult& result) {
  out << "kind             " << ToString(result.kind) << (result.grazing ? ", grazing" : "")
      << "\n";
  if (result.kind == TravelKind::kInterval) {
    PrintEnd(out, "enter            ", result.enter);
    PrintEnd(out, "leave            ", result.leave);
  } else if (result.kind == TravelKind::kNever) {
    out << "separator        " << PairsText(result.separator) << "\n";
  }
  PrintCounts(out, result.tier, result.counts, result.exact_signs);
}

void PrintResult(std::ostream& out, const PublishedTravel& result) {
  out << "published        " << ToString(result.kind) << "\n";
  if (result.kind == PublishedTravelKind::kNever) return;
  out << "c                " << ShortDouble(result.c_travel) << " s, from " << Text(result.corners)
      << "\n";
  if (result.kind == PublishedTravelKind::kTravel) {
    out << "travel           " << ShortDouble(result.travel) << ", by "
        << ToString(result.face_class) << ": " << Text(result.feature_p) << " of P, "
        << Text(result.feature_q) << " of Q\n";
  }
}

}  // namespace touchstone
