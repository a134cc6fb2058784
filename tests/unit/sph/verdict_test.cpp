// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/verdict.h"

#include "core/tensor.h"

#include <algorithm>
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

/// A mass that slides three times as fast as the root mean square of the body.
std::function<double(double)> slide(const std::function<double(double)>& s)
{
  return [s](double t)
  {
    double u = 0;
    for (double k = 1; k <= t; ++k)
      u += 3 * s(k);
    return u;
  };
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
  const auto growing = [](double t) { return 0.005 * std::exp(0.1 * t); };
  const Result r = judge(growing, slide(growing));
  EXPECT_EQ(r.outcome, Outcome::fails);
  EXPECT_LT(r.time, 11);
}

TEST(Verdict, ADipBeforeTheGrowthStillFails)
{
  const auto dip = [](double t) { return 0.009 + 2e-4 * (t - 12) * (t - 12); };
  EXPECT_EQ(judge(dip, slide(dip)).outcome, Outcome::fails);
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
  const Result r = judge(plateau, slide(plateau));
  EXPECT_EQ(r.outcome, Outcome::stands);
  EXPECT_EQ(r.time, 25);
}

TEST(Verdict, LargeDisplacementThatGoesOnFails)
{
  const Result r =
      judge([](double t) { return 0.05 * std::exp(-0.04 * t); }, [](double t) { return 0.5 * t; });
  EXPECT_EQ(r.outcome, Outcome::fails);
}

TEST(Verdict, SoilThatOnlySwingsStands)
{
  // The course of the dry embankment at F = 2.25 with a local damping of 0.2: s falls, but every
  // other window is above the one before by 40 %, while the largest displacement stays where it is.
  const auto swing = [](double t)
  { return 0.03 * std::exp(-0.15 * t) * (1 + 0.3 * std::cos(pi * t)); };
  const auto u = [&](double t) { return 0.51 + 0.2 * swing(t); };
  EXPECT_EQ(judge(swing, u).outcome, Outcome::stands);
  // The same course in which the soil does go somewhere.
  EXPECT_EQ(judge(swing, slide(swing)).outcome, Outcome::fails);
}

TEST(Verdict, SwingsFarFromTheStartAreNoSlide)
{
  // Far gone, and fast: only that nothing is gained speaks for the slope.
  const auto swing = [](double t) { return std::max(5e-4, 0.05 - 1e-3 * t); };
  const auto u = [](double t) { return 5 + 0.01 * std::cos(pi * t); };
  EXPECT_EQ(judge(swing, u).outcome, Outcome::stands);
}

TEST(Verdict, CreepThatNeitherStopsNorGrowsIsUndecided)
{
  const Result r = judge([](double) { return 3e-3; }, small);
  EXPECT_EQ(r.outcome, Outcome::undecided);
  EXPECT_EQ(r.time, Verdict::longest);
}
} // namespace berm::sph
