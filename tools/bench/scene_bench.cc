// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/scene_bench.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/tools/bench/times.h"
#include "touchstone/tools/engines/world.h"
#include "touchstone/tools/suites/random.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Pairs = std::vector<std::pair<int, int>>;

constexpr int kVertices = 100;
constexpr int kShapes = 16;
constexpr double kVolumePerBody = 16.0;
constexpr double kStep = 0.01;
constexpr int kTargetBodies = 10000;

// Where all bodies are, step by step: the same for every engine.
class Course {
 public:
  Course(int bodies, SceneMotion motion, std::uint64_t seed)
      : motion_(motion),
        random_("scene", seed, static_cast<std::uint64_t>(bodies)),
        half_(0.5 * std::cbrt(kVolumePerBody * bodies)),
        poses_(bodies),
        velocities_(bodies),
        turns_(bodies) {
    for (int i = 0; i < bodies; ++i) {
      poses_[i].rotation = random_.Rotation();
      for (double& x : poses_[i].translation) x = random_.Uniform(-half_, half_);
      velocities_[i] = kStep * random_.SpherePoint();
      turns_[i] = Eigen::AngleAxisd(kStep, random_.SpherePoint()).toRotationMatrix();
    }
  }

  const std::vector<WorldPose>& poses() const { return poses_; }

  void Advance() {
    if (motion_ == SceneMotion::kStatic) return;
    ++steps_;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      WorldPose& pose = poses_[i];
      if (motion_ == SceneMotion::kChaotic) {
        pose.rotation = random_.Rotation();
        for (double& x : pose.translation) {
          x = std::clamp(x + random_.Uniform(-1.0, 1.0), -half_, half_);
        }
        continue;
      }
      pose.rotation = turns_[i] * pose.rotation;
      pose.translation += velocities_[i];
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(pose.translation[axis]) > half_) velocities_[i][axis] *= -1.0;
      }
    }
  }

 private:
  SceneMotion motion_;
  Random random_;
  double half_;
  std::vector<WorldPose> poses_;
  std::vector<Vector3d> velocities_;
  std::vector<Matrix3d> turns_;
  long steps_ = 0;
};

double Seconds(bool wall) {
  if (wall) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  return ProcessorSeconds();
}

struct Plan {
  int bodies;
  SceneMotion motion;
  int settle, timed;  // steps
};

struct Timing {
  double median_ms = 0.0;
  Pairs pairs;
};

std::vector<ConvexPolyhedron> MakeShapes(std::uint64_t seed) {
  Random random("scene shapes", seed, 0);
  std::vector<ConvexPolyhedron> shapes;
  for (int i = 0; i < kShapes; ++i) {
    shapes.push_back(EllipsoidBody(random, kVertices, Vector3d(1.0, 0.8, 0.6)));
  }
  return shapes;
}

template <class StepDone>
Timing TimeWorld(World* world, const std::vector<ConvexPolyhedron>& shapes, const Plan& plan,
                 std::uint64_t seed, bool wall, StepDone step_done) {
  Course course(plan.bodies, plan.motion, seed);
  for (const ConvexPolyhedron& shape : shapes) world->AddShape(shape);
  for (int i = 0; i < plan.bodies; ++i) world->AddBody(i % kShapes, course.poses()[i]);
  world->Step();
  std::vector<double> times;
  for (int step = 0; step < plan.settle + plan.timed; ++step) {
    course.Advance();
    const double begin = Seconds(wall);
    if (plan.motion != SceneMotion::kStatic) {
      for (int i = 0; i < plan.bodies; ++i) world->Move(i, course.poses()[i]);
    }
    world->Step();
    const double end = Seconds(wall);
    if (step < plan.settle) continue;
    times.push_back(1e3 * (end - begin));
    step_done();
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  return {times[times.size() / 2], world->MeetingPairs()};
}

// Pairs that one list has and the other has not, but for those that touch.
long CountMismatches(const Pairs& said, const Pairs& proven,
                     const std::vector<ConvexPolyhedron>& shapes,
                     const std::vector<WorldPose>& poses) {
  Pairs differ;
  std::set_symmetric_difference(said.begin(), said.end(), proven.begin(), proven.end(),
                                std::back_inserter(differ));
  return std::count_if(differ.begin(), differ.end(), [&](const auto& pair) {
    const auto pose = RelativePose::FromWorld(poses[pair.first], poses[pair.second]);
    return Collide(shapes[pair.first % kShapes], shapes[pair.second % kShapes], *pose).verdict !=
           Verdict::kTouch;
  });
}

std::vector<std::pair<std::string, SceneRules>> RulesOff() {
  std::vector<std::pair<std::string, SceneRules>> all;
  const auto add = [&](const char* name, auto change) {
    SceneRules rules;
    change(rules);
    all.emplace_back(std::string("touchstone without ") + name, rules);
  };
  add("margins", [](SceneRules& r) { r.margins = false; });
  add("rest", [](SceneRules& r) { r.rest = false; });
  add("balls", [](SceneRules& r) { r.balls = false; });
  add("guesses", [](SceneRules& r) { r.guesses = false; });
  add("verdict_alone", [](SceneRules& r) { r.verdict_alone = false; });
  add("doubles_first", [](SceneRules& r) { r.doubles_first = false; });
  add("tree", [](SceneRules& r) { r.broad_phase = BroadPhase::kSweep; });
  add("broad phase", [](SceneRules& r) { r.broad_phase = BroadPhase::kAllPairs; });
  return all;
}

class Bench {
 public:
  explicit Bench(const SceneBenchOptions& options)
      : options_(options), shapes_(MakeShapes(options.seed)) {}

  SceneBenchReport Run() {
    const std::vector<Plan> plans = Plans();
    for (std::size_t i = 0; i < plans.size(); ++i) {
      RunPlan(plans[i]);
      options_.progress(static_cast<double>(i + 1) / static_cast<double>(plans.size()));
    }
    FitExponent();
    return std::move(report_);
  }

 private:
  std::vector<Plan> Plans() const {
    std::vector<Plan> plans;
    for (const int bodies : {100, 1000, 10000, 100000}) {
      const int timed = bodies <= 1000 ? 40 : bodies <= 10000 ? 16 : options_.quick ? 6 : 12;
      plans.push_back({bodies, SceneMotion::kStatic, 2, timed});
      plans.push_back({bodies, SceneMotion::kCoherent, bodies <= 10000 ? 20 : 8, timed});
      const int chaotic = options_.quick ? std::max(3, timed / 4) : timed;
      plans.push_back({bodies, SceneMotion::kChaotic, 2, chaotic});
    }
    return plans;
  }

  void Add(const std::string& engine, const Plan& plan, const Timing& timing, long mismatches) {
    report_.rows.push_back({engine, plan.bodies, plan.motion, timing.median_ms,
                            static_cast<long>(timing.pairs.size()), mismatches});
  }

  void RunPlan(const Plan& plan) {
    const Timing ours = TimeOurs(plan);
    // The poses of the last step, once more.
    Course course(plan.bodies, plan.motion, options_.seed);
    for (int step = 0; step < plan.settle + plan.timed; ++step) course.Advance();
    Add("touchstone", plan, ours, CountWrong(plan, ours.pairs, course.poses()));
    const auto compare = [&](const std::string& name, World* world, bool wall) {
      const Timing timing = TimeWorld(world, shapes_, plan, options_.seed, wall, [] {});
      Add(name, plan, timing, CountMismatches(timing.pairs, ours.pairs, shapes_, course.poses()));
    };
    if (HasThreads() && !options_.quick) {
      compare("touchstone threads", MakeSceneWorld({{}, Threads::kAll}).get(), true);
    }
    for (const WorldDescription& other : OtherWorlds()) {
      if (!other.unavailable.empty()) continue;
      if (options_.quick && plan.bodies > kTargetBodies) continue;
      compare(other.name, other.make().get(), false);
    }
    const bool is_target = plan.bodies == kTargetBodies && plan.motion == SceneMotion::kCoherent;
    const bool is_small = plan.bodies == 1000 && plan.motion == SceneMotion::kCoherent;
    const bool is_tiny = plan.bodies == 100 && plan.motion == SceneMotion::kCoherent;
    for (const auto& [name, rules] : RulesOff()) {
      // Exact signs for all looks, or all pairs of 10,000 bodies, would take the whole run.
      const bool fits = !rules.doubles_first ? is_tiny
                        : rules.broad_phase == BroadPhase::kAllPairs
                            ? is_small
                            : is_small || (is_target && !options_.quick);
      if (fits) compare(name, MakeSceneWorld({rules, Threads::kOne}).get(), false);
    }
  }

  // Our own scene, with its counters and its memory.
  Timing TimeOurs(const Plan& plan) {
    Scene scene;
    class Counting : public World {
     public:
      explicit Counting(Scene* counted) : scene_(*counted) {}
      void AddShape(const ConvexPolyhedron& body) override {
        shapes_.push_back(SceneShape::Convex(body));
      }
      void AddBody(int shape, const WorldPose& pose) override {
        bodies_.push_back(*scene_.Add(shapes_[shape], pose));
      }
      void Move(int body, const WorldPose& pose) override { scene_.Move(bodies_[body], pose); }
      void Step() override { last = scene_.Step(); }
      Pairs MeetingPairs() const override {
        Pairs pairs;
        for (const SceneEvent& event : last.events) {
          if (event.kind == EventKind::kEnd) continue;
          pairs.emplace_back(event.bodies.a.slot, event.bodies.b.slot);
        }
        return pairs;
      }
      SceneStep last;

     private:
      Scene& scene_;
      std::vector<SceneShape> shapes_;
      std::vector<BodyHandle> bodies_;
    } world(&scene);
    SceneCounters counters;
    const Timing timing = TimeWorld(&world, shapes_, plan, options_.seed, false,
                                    [&] { counters.Add(world.last.counters); });
    if (plan.motion != SceneMotion::kCoherent) return timing;
    if (plan.bodies == kTargetBodies) {
      report_.counters = counters;
      report_.counted_steps = plan.timed;
    }
    const Scene::Memory memory = scene.memory();
    report_.bytes_per_body = static_cast<double>(memory.bodies) / plan.bodies;
    report_.bytes_per_pair = static_cast<double>(memory.pairs) /
                             static_cast<double>(std::max<long>(1, world.last.counters.pairs));
    return timing;
  }

  // Our own pairs against every pair of bodies, each asked of Collide; of large scenes the pairs of
  // the first bodies only, with all others.
  long CountWrong(const Plan& plan, const Pairs& said, const std::vector<WorldPose>& poses) const {
    const int first = std::min(plan.bodies, std::max(4, 400000 / plan.bodies));
    Pairs proven, about;
    for (int i = 0; i < first; ++i) {
      for (int j = i + 1; j < plan.bodies; ++j) {
        const auto pose = RelativePose::FromWorld(poses[i], poses[j]);
        const CollideResult result =
            Collide(shapes_[i % kShapes], shapes_[j % kShapes], *pose, {.early_exit = true});
        if (result.verdict != Verdict::kSeparate) proven.emplace_back(i, j);
      }
    }
    std::copy_if(said.begin(), said.end(), std::back_inserter(about),
                 [&](const auto& pair) { return pair.first < first; });
    Pairs differ;
    std::set_symmetric_difference(about.begin(), about.end(), proven.begin(), proven.end(),
                                  std::back_inserter(differ));
    return static_cast<long>(differ.size());
  }

  void FitExponent() {
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (const SceneBenchRow& row : report_.rows) {
      if (row.engine != "touchstone" || row.motion != SceneMotion::kCoherent) continue;
      if (row.bodies < 1000) continue;
      const double x = std::log(row.bodies), y = std::log(row.median_ms_per_step);
      n += 1.0;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
    if (n >= 2.0) report_.exponent = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  }

  const SceneBenchOptions& options_;
  std::vector<ConvexPolyhedron> shapes_;
  SceneBenchReport report_;
};

}  // namespace

std::string_view ToString(SceneMotion motion) {
  switch (motion) {
    case SceneMotion::kStatic:
      return "static";
    case SceneMotion::kCoherent:
      return "coherent";
    case SceneMotion::kChaotic:
      return "chaotic";
  }
  return "?";
}

SceneBenchReport RunSceneBench(const SceneBenchOptions& options) { return Bench(options).Run(); }

const SceneBenchRow* FindRow(const SceneBenchReport& report, const std::string& engine, int bodies,
                             SceneMotion motion) {
  for (const SceneBenchRow& row : report.rows) {
    if (row.engine == engine && row.bodies == bodies && row.motion == motion) return &row;
  }
  return nullptr;
}

}  // namespace touchstone
