// SPDX-License-Identifier: GPL-3.0-or-later
/// Claim D-10 of docs/verification.md: the factor of safety, to half a percent, does not depend on
/// what the engine keeps to itself. Two slopes of 880 particles; more of them in
/// numerics_slow_test.cpp.
#include "tests/support/changes.h"

#include <gtest/gtest.h>
#include <omp.h>

namespace berm::tests
{
namespace
{
constexpr double spacing = 0.5; // [m]

struct Row
{
  PublishedSlope slope;
  double F;
};

const std::vector<Row>& rows()
{
  static const std::vector<Row> all = []
  {
    std::vector<Row> some;
    for (const PublishedSlope& s : published_slopes())
      if (s.name == "F-2" || s.name == "F-3 L/H = 1/2")
        some.push_back({s, narrow_factor(s, spacing)});
    return some;
  }();
  return all;
}

/// 0.5 % is what is asked for; a bracket is 0.3 % wide.
void expect_same_factor(const std::vector<Change>& changes, double relative = 0.005)
{
  ASSERT_EQ(rows().size(), 2);
  for (const Row& row : rows())
    for (const Change& change : changes)
      EXPECT_NEAR(narrow_factor(row.slope, spacing, change, row.F) / row.F, 1, relative)
          << row.slope.name << ", " << change.name;
}
} // namespace

TEST(FactorOfSafetyNumerics, DoesNotDependOnDamping)
{
  expect_same_factor(changes_of_damping());
}

TEST(FactorOfSafetyNumerics, DoesNotDependOnTheTimeStep)
{
  expect_same_factor(changes_of_time_step());
}

TEST(FactorOfSafetyNumerics, DoesNotDependOnYoungsModulus)
{
  expect_same_factor(changes_of_stiffness());
}

TEST(FactorOfSafetyNumerics, DoesNotDependOnOriginAndSide)
{
  expect_same_factor(changes_of_frame());
}

// Without dilation the limit load is not unique: it depends on the stress it is reached from. 0.5 %
// does not hold: F-3 from K0 = 1, 1.2 % (measured).
TEST(FactorOfSafetyNumerics, DependsLittleOnTheInitialStress)
{
  expect_same_factor(changes_of_initial_stress(), 0.015);
}

TEST(FactorOfSafetyNumerics, HasTheSameTrialsForAnyNumberOfThreads)
{
  const int before = omp_get_max_threads();
  const auto search = [](int threads)
  {
    omp_set_num_threads(threads);
    const Row& row = rows().front();
    coupling::Case c = row.slope.at_one_metre;
    c.sph.spacing = spacing;
    return SettledSlope(c).factor_of_safety({.lower = 0.8 * row.slope.reference,
                                             .upper = 1.2 * row.slope.reference,
                                             .tolerance = 0.01,
                                             .guess = row.F});
  };
  const sph::FactorOfSafety one = search(1), three = search(3);
  omp_set_num_threads(before);
  ASSERT_EQ(one.trials.size(), three.trials.size());
  ASSERT_GE(one.trials.size(), 2);
  for (std::size_t k = 0; k < one.trials.size(); ++k)
  {
    EXPECT_EQ(one.trials[k].factor, three.trials[k].factor);
    EXPECT_EQ(one.trials[k].outcome, three.trials[k].outcome);
    EXPECT_EQ(one.trials[k].velocity_measure, three.trials[k].velocity_measure); // every bit
    EXPECT_EQ(one.trials[k].max_displacement, three.trials[k].max_displacement);
  }
}
} // namespace berm::tests
