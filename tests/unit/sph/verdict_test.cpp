// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/verdict.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace berm::sph
{
namespace
{
struct Result
{
  Outcome outcome;
  double time;
};

/// Feed windows of one T0 with velocity measure s(t) and displacement u(t) until the verdict is
/// known.
Result judge(const std::function<double(double)>& s, const std::function<double(double)>& u)
{
  Verdict verdict;
  double t = 1;
  while (!verdict.add_window(t, s(t), u(t)))
    t += 1;
  return {verdict.outcome(), t};
}

double small(double)
{
  return 0.3;
}
} // namespace

TEST(Verdict, ADecayingVelocityStands)
{
  const Result r = judge([](double t) { return 0.05 * std::exp(-0.3 * t); }, small);
  EXPECT_EQ(r.outcome, Outcome::stands);
  EXPECT_LT(r.time, 15);
}

TEST(Verdict, AGrowingVelocityFails)
{
  const Result r = judge([](double t) { return 0.005 * std::exp(0.1 * t); }, small);
  EXPECT_EQ(r.outcome, Outcome::fails);
  EXPECT_LT(r.time, 11);
}

TEST(Verdict, ADipBeforeTheGrowthStillFails)
{
  const auto dip = [](double t) { return 0.009 + 2e-4 * (t - 12) * (t - 12); };
  EXPECT_EQ(judge(dip, small).outcome, Outcome::fails);
}

TEST(Verdict, ASlowDecayIsWaitedFor)
{
  const Result r = judge([](double t) { return 0.02 * std::exp(-0.04 * t); }, small);
  EXPECT_EQ(r.outcome, Outcome::stands);
  EXPECT_GT(r.time, 60);
}

TEST(Verdict, APlateauThatSinksIsNotAFailure)
{
  // The course of the embankment with seepage at F = 1.6133: a plateau of ten T0, then rest.
  const auto plateau = [](double t) {
    return t < 14 ? 0.03 * std::exp(-0.13 * t) : t < 25 ? 5.2e-3 - 1e-4 * (t - 14) : 5e-4;
  };
  const Result r = judge(plateau, small);
  EXPECT_EQ(r.outcome, Outcome::stands);
  EXPECT_EQ(r.time, 25);
}

TEST(Verdict, LargeDisplacementThatGoesOnFails)
{
  const Result r =
      judge([](double t) { return 0.05 * std::exp(-0.04 * t); }, [](double t) { return 0.5 * t; });
  EXPECT_EQ(r.outcome, Outcome::fails);
}

TEST(Verdict, CreepThatNeitherStopsNorGrowsIsUndecided)
{
  const Result r = judge([](double) { return 3e-3; }, small);
  EXPECT_EQ(r.outcome, Outcome::undecided);
  EXPECT_EQ(r.time, Verdict::longest);
}
} // namespace berm::sph
