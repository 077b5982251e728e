// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "touchstone/tools/scene/scene_file.h"
#include "touchstone/tools/suites/random.h"

namespace touchstone {
namespace {

Json List(double x, double y, double z) { return Json::array({x, y, z}); }
Json Pair(const char* a, const char* b) { return Json::array({a, b}); }

// A wall of boxes that touch exactly, face to face, and a hull that flies through it.
Json BoxStack() {
  Json scene = {{"comment", "a wall of boxes that touch, a hull that flies through it"},
                {"shapes",
                 {{"box", {{"box", List(0.5, 0.5, 0.5)}}},
                  {"ball", {{"hull", {{"vertices", 60}, {"semi_axes", List(0.9, 0.9, 0.9)}}}}}}},
                {"bodies", Json::array()},
                {"steps", 240}};
  for (int layer = 0; layer < 6; ++layer) {
    for (int i = 0; i < 10 - layer; ++i) {
      Json box = {{"shape", "box"}, {"position", List(i + 0.5 * layer, 0.0, layer)}};
      // The topmost slide, by halves and quarters, so that faces stay in one plane exactly.
      if (layer == 5) box["motion"] = {{"velocity", List(0.015625, 0, 0)}};
      scene["bodies"].push_back(box);
    }
  }
  scene["bodies"].push_back({{"name", "ball"},
                             {"shape", "ball"},
                             {"position", List(4.25, -4.0, 2.25)},
                             {"motion",
                              {{"velocity", List(0, 0.03125, 0)},
                               {"spin", List(0.02, 0.01, 0)},
                               {"within", List(20, 4, 20)}}},
                             {"subscriptions", {{"depth", true}}}});
  return scene;
}

// Hulls that fall, turn, and are thrown back by the walls of a box.
Json HullRain() {
  Json scene = {{"comment", "hulls that fall in a box whose walls throw them back"},
                {"shapes", Json::object()},
                {"bodies", Json::array()},
                {"steps", 200}};
  for (int k = 0; k < 6; ++k) {
    scene["shapes"]["hull" + std::to_string(k)] = {
        {"hull",
         {{"vertices", 20 + 30 * k}, {"semi_axes", List(0.5, 0.4, 0.25 + 0.05 * k)}, {"seed", k}}}};
  }
  scene["shapes"]["floor"] = {{"box", List(6, 6, 0.5)}};
  scene["bodies"].push_back(
      {{"name", "floor"}, {"shape", "floor"}, {"position", List(0, 0, -4.5)}});
  Random random("scene demo", 1, 0);
  for (int i = 0; i < 160; ++i) {
    const auto number = [&](double half) { return random.Uniform(-half, half); };
    Json body = {{"shape", "hull" + std::to_string(i % 6)},
                 {"position", List(number(5), number(5), number(4))},
                 {"turn", List(number(3), number(3), number(3))},
                 {"motion",
                  {{"velocity", List(number(0.01), number(0.01), -0.03 + number(0.01))},
                   {"spin", List(number(0.03), number(0.03), number(0.03))},
                   {"within", List(5, 5, 4.25)}}}};
    scene["bodies"].push_back(body);
  }
  return scene;
}

// Gears in a train, their teeth in each other's gaps, the last one pushed out of step.
Json Gears() {
  Json scene = {
      {"comment",
       "a train of gears; the last turns too fast and collides; distances below 0.05, depths"},
      {"shapes", Json::object()},
      {"bodies", Json::array()},
      {"steps", 200}};
  const std::array<int, 5> teeth = {20, 12, 30, 16, 24};
  double x = 0.0, sense = 1.0, phase = 0.0;
  for (std::size_t i = 0; i < teeth.size(); ++i) {
    const std::string name = "gear" + std::to_string(teeth[i]);
    scene["shapes"][name] = {{"mesh", "gear"}, {"faces", 16 * teeth[i]}};
    if (i > 0) {
      x += 0.1 * (teeth[i - 1] + teeth[i]);
      // The neighbour's gap is at this angle; a tooth of an even number of teeth meets it half a
      // pitch on.
      phase = std::numbers::pi / teeth[i] * (i % 2 == 1 ? 1.0 : 0.0);
    }
    const double speed = sense * 0.2 / teeth[i] * (i + 1 == teeth.size() ? 1.25 : 1.0);
    scene["bodies"].push_back(
        {{"name", "gear " + std::to_string(i)},
         {"shape", name},
         {"position", List(x, 0, 0)},
         {"subscriptions", {{"distance", 0.05}, {"depth", i == 4}, {"cpd", i == 4}}},
         {"turn", List(0, 0, phase)},
         {"motion", {{"spin", List(0, 0, speed)}}}});
    sense = -sense;
  }
  return scene;
}

// An arm of compounds on hinges, each in the frame of the one before, among obstacles.
Json RobotArm() {
  const auto box = [](double hx, double hy, double hz, double x, double y, double z) {
    return Json{{"box", List(hx, hy, hz)}, {"at", List(x, y, z)}};
  };
  Json scene = {
      {"comment",
       "an arm of three links and a gripper among pillars; distances below 0.3, depths, and how "
       "far the "
       "gripper may go on"},
      {"shapes",
       {{"base",
         {{"compound", {box(0.5, 0.5, 0.25, 0, 0, 0.25), box(0.25, 0.25, 0.5, 0, 0, 1.0)}}}},
        {"link",
         {{"compound",
           {box(0.2, 0.2, 0.9, 0, 0, 0.9), box(0.3, 0.3, 0.2, 0, 0, 0.1),
            box(0.3, 0.3, 0.2, 0, 0, 1.7)}}}},
        {"gripper",
         {{"compound",
           {box(0.3, 0.1, 0.1, 0, 0, 0.1), box(0.05, 0.1, 0.3, 0.25, 0, 0.4),
            box(0.05, 0.1, 0.3, -0.25, 0, 0.4)}}}},
        {"pillar", {{"hull", {{"vertices", 40}, {"semi_axes", List(0.3, 0.3, 1.5)}}}}},
        {"shelf",
         {{"compound",
           {box(1.0, 0.5, 0.05, 0, 0, 0), box(1.0, 0.5, 0.05, 0, 0, 1.0),
            box(0.05, 0.5, 0.5, -1.0, 0, 0.5), box(0.05, 0.5, 0.5, 1.0, 0, 0.5)}}}}}},
      {"bodies", Json::array()},
      {"ignore", Json::array({Pair("base", "upper"), Pair("upper", "middle"),
                              Pair("middle", "lower"), Pair("lower", "gripper")})},
      {"steps", 300}};
  const auto add = [&](const char* name, const char* shape, Json position, const char* parent,
                       Json axis, double amplitude, double period) {
    Json body = {{"name", name}, {"shape", shape}, {"position", position}};
    body["motion"] = {
        {"hinge",
         {{"point", position}, {"axis", axis}, {"amplitude", amplitude}, {"period", period}}}};
    if (parent != nullptr) body["motion"]["parent"] = parent;
    body["subscriptions"] = {{"distance", 0.3}, {"depth", true}};
    scene["bodies"].push_back(body);
  };
  scene["bodies"].push_back({{"name", "base"}, {"shape", "base"}});
  add("upper", "link", List(0, 0, 1.6), nullptr, List(0, 0.2, 1), 1.4, 300);
  add("middle", "link", List(0, 0, 1.8), "upper", List(1, 0, 0), 1.0, 210);
  add("lower", "link", List(0, 0, 1.8), "middle", List(1, 0.3, 0), 1.3, 150);
  add("gripper", "gripper", List(0, 0, 1.9), "lower", List(0, 1, 0), 0.8, 60);
  scene["bodies"].back()["subscriptions"]["travel"] = {{"direction", List(0, 0, -1)}, {"reach", 2}};
  for (int i = 0; i < 8; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 8.0;
    scene["bodies"].push_back(
        {{"name", "pillar " + std::to_string(i)},
         {"shape", "pillar"},
         {"position", List(1.9 * std::cos(angle), 1.9 * std::sin(angle), 1.5 + 0.5 * (i % 3))}});
  }
  scene["bodies"].push_back(
      {{"name", "shelf"}, {"shape", "shelf"}, {"position", List(0.5, 2.6, 3.0)}});
  return scene;
}

// Pairs of linked tori, shaken until the links meet.
Json Tori() {
  Json scene = {{"comment", "pairs of linked tori, shaken; distances below 0.3, continuous depths"},
                {"shapes", {{"torus", {{"mesh", "torus"}, {"faces", 800}}}}},
                {"bodies", Json::array()},
                {"steps", 200}};
  for (int i = 0; i < 6; ++i) {
    const double x = 7.0 * (i / 2) + 2.0 * (i % 2);
    Json body = {{"name", "link " + std::to_string(i)},
                 {"shape", "torus"},
                 {"subscriptions", {{"distance", 0.3}, {"cpd", true}}},
                 {"position", List(x, 0, 0)},
                 {"turn", List(i % 2 == 0 ? 0.0 : 0.5 * std::numbers::pi, 0, 0)},
                 {"motion",
                  {{"hinge",
                    {{"point", List(x, 0, i % 2 == 0 ? 3.0 : -3.0)},
                     {"axis", List(0.3, 1, 0.1 * i)},
                     {"amplitude", 0.02 + 0.03 * i},
                     {"period", 90 + 13 * i}}}}}};
    scene["bodies"].push_back(body);
  }
  return scene;
}

const std::map<std::string, std::function<Json()>>& Demos() {
  static const std::map<std::string, std::function<Json()>> kDemos = {{"box-stack", BoxStack},
                                                                      {"hull-rain", HullRain},
                                                                      {"gears", Gears},
                                                                      {"robot-arm", RobotArm},
                                                                      {"tori", Tori}};
  return kDemos;
}

}  // namespace

Json MakeDemo(const std::string& name) {
  const auto found = Demos().find(name);
  return found == Demos().end() ? Json() : found->second();
}

std::span<const std::string> DemoNames() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const auto& [name, make] : Demos()) names.push_back(name);
    return names;
  }();
  return kNames;
}

}  // namespace touchstone
