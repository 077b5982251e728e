// SPDX-License-Identifier: GPL-3.0-or-later
//
// Prints how many results a second the proof tier judges; asserts nothing but that they pass.
#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>

#include "touchstone/exact/decide.h"
#include "touchstone/exact/judge.h"
#include "touchstone/tests/exact/shapes.h"

namespace touchstone::exact {
namespace {

struct Query {
  ExactBody p, q;
  RelativePose pose;
  CollideResult result;
};

std::vector<Query> MakeQueries(int n, int count) {
  Random random(41);
  std::vector<Query> queries;
  for (int i = 0; i < count; ++i) {
    const ExactBody p(EllipsoidHull(&random, n, {2, 1, 1})),
        q(EllipsoidHull(&random, n, {2, 1, 1}));
    const RelativePose pose =
        Pose(RoundedRotation(&random), random.Real(0.5, 3.5) * random.OnSphere());
    queries.push_back({p, q, pose, GoodResult(p, q, pose)});
    AddPhaseMaxima(p, q, pose, &queries.back().result);
  }
  return queries;
}

template <class Work>
double PerSecond(const std::vector<Query>& queries, const Work& work) {
  long done = 0;
  const std::clock_t start = std::clock();  // the processor's time: others may share the machine
  double spent = 0.0;
  do {
    for (const Query& query : queries) work(query);
    done += static_cast<long>(queries.size());
    spent = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  } while (spent < 0.3);
  return static_cast<double>(done) / spent;
}

TEST(Rates, JudgedPerSecond) {
  for (const int n : {20, 100}) {
    const std::vector<Query> queries = MakeQueries(n, n == 20 ? 100 : 10);
    const auto judge = [](const Query& query, bool maxima) {
      EXPECT_TRUE(Judge(query.p, query.q, query.pose, query.result, {.check_phase_maxima = maxima})
                      .empty());
    };
    const double plain = PerSecond(queries, [&](const Query& query) { judge(query, false); });
    const double maxima = PerSecond(queries, [&](const Query& query) { judge(query, true); });
    const double fresh = PerSecond(queries, [&](const Query& query) {
      const ExactBody p(query.p.body()), q(query.q.body());
      EXPECT_TRUE(Judge(p, q, query.pose, query.result, {.check_phase_maxima = false}).empty());
    });
    const double decided =
        PerSecond(queries, [](const Query& query) { Decide(query.p, query.q, query.pose); });
    std::printf(
        "n = %d: judged/s %.0f, with phase maxima %.0f, with fresh bodies %.0f; decided/s %.0f\n",
        n, plain, maxima, fresh, decided);
  }
}

}  // namespace
}  // namespace touchstone::exact
