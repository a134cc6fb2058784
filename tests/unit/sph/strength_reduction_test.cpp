// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/strength_reduction.h"

#include <cmath>
#include <gtest/gtest.h>

namespace berm::sph
{
namespace
{
/// A soil that fails above a known factor, with an undecided gap above and below it if asked for.
RunTrial fake_soil(double critical, double gap = 0)
{
  return [=](double factor, Observer&)
  {
    Trial trial;
    trial.factor = factor;
    trial.outcome = std::abs(factor - critical) < gap ? Outcome::undecided
                    : factor < critical               ? Outcome::stands
                                                      : Outcome::fails;
    trial.state.ux = {factor};
    return trial;
  };
}

FactorOfSafety search(const RunTrial& soil, SearchSettings settings = {})
{
  Observer silent;
  return reduce_strength(soil, settings, silent);
}

class StopsAtOnce : public Observer
{
public:
  [[nodiscard]] bool stop_requested() const override { return true; }
};
} // namespace

TEST(StrengthReduction, BracketsAnyFactorInsideAndOutsideItsRange)
{
  for (const double critical : {0.11, 0.3, 0.5001, 0.98, 1.0, 1.63, 2.3777, 2.999, 3.2, 7.7})
  {
    const FactorOfSafety F = search(fake_soil(critical));
    ASSERT_TRUE(F.complete) << critical << ": " << F.reason;
    EXPECT_LE(*F.stands, critical);
    EXPECT_GE(*F.fails, critical);
    EXPECT_LE(*F.fails - *F.stands, 0.02 + 1e-12);
    EXPECT_EQ(*F.factor(), 0.5 * (*F.stands + *F.fails));
  }
}

TEST(StrengthReduction, AGoodGuessNeedsTwoTrialsAndABadOneCostsTimeOnly)
{
  const auto trials = [](double critical, double guess)
  {
    const FactorOfSafety F = search(fake_soil(critical), {.tolerance = 0.01, .guess = guess});
    EXPECT_TRUE(F.complete) << F.reason;
    EXPECT_LE(*F.stands, critical);
    EXPECT_GE(*F.fails, critical);
    EXPECT_LE(*F.fails - *F.stands, 0.02);
    return F.trials.size();
  };
  EXPECT_EQ(trials(1.605, 1.6), 2u);
  EXPECT_EQ(trials(1.58, 1.6), 2u); // both below the guess: the upper end was tried as the lower
  EXPECT_EQ(trials(1.62, 1.6), 3u);
  // Strides of 0.02 that double until they pass the answer, then bisection of the last.
  EXPECT_LE(trials(2.5, 1.6), 2 + 2 * std::ceil(std::log2(1 + 0.9 / 0.02)));
  EXPECT_LE(trials(0.2, 1.6), 2 + 2 * std::ceil(std::log2(1 + 1.4 / 0.02)));
}

TEST(StrengthReduction, BothEndsOfTheBracketWereTried)
{
  const FactorOfSafety F = search(fake_soil(0.503));
  ASSERT_TRUE(F.complete);
  ASSERT_NE(F.standing_trial(), nullptr);
  ASSERT_NE(F.failing_trial(), nullptr);
  EXPECT_EQ(F.standing_trial()->outcome, Outcome::stands);
  EXPECT_EQ(F.failing_trial()->outcome, Outcome::fails);
}

TEST(StrengthReduction, TakesNoMoreTrialsThanBisectionNeeds)
{
  const FactorOfSafety F = search(fake_soil(1.7), {.lower = 1, .upper = 3, .tolerance = 0.01});
  EXPECT_EQ(F.trials.size(), 7u); // 2 / 2^7 = 0.0156 < 0.02
}

TEST(StrengthReduction, ReachesAFactorFarOutsideItsRangeInAFewTrialsForEachStep)
{
  const FactorOfSafety F = search(fake_soil(34.5), {.max_factor = 100});
  ASSERT_TRUE(F.complete) << F.reason;
  // From 3 to 34.5 in steps of 1.5: seven ends with three bisections before each, then
  // log2(12 / 0.02) = 10 more.
  EXPECT_LE(F.trials.size(), 4u * 7u + 10u);
}

TEST(StrengthReduction, KeepsOnlyTheStatesOfTheBracket)
{
  const FactorOfSafety F = search(fake_soil(1.63));
  for (const Trial& trial : F.trials)
    EXPECT_EQ(trial.state.ux.empty(), trial.factor != *F.stands && trial.factor != *F.fails);
  EXPECT_EQ(F.failing_trial()->state.ux.front(), *F.fails);
}

TEST(StrengthReduction, AnUndecidedTrialIsPassedBy)
{
  // 1.75 is the first middle of [0.5, 3]; only it is undecided.
  const RunTrial soil = [inner = fake_soil(1.9)](double factor, Observer& observer)
  {
    Trial trial = inner(factor, observer);
    if (factor == 1.75)
      trial.outcome = Outcome::undecided;
    return trial;
  };
  const FactorOfSafety F = search(soil);
  EXPECT_TRUE(F.complete) << F.reason;
  EXPECT_LE(*F.stands, 1.9);
  EXPECT_GE(*F.fails, 1.9);
}

TEST(StrengthReduction, AWideUndecidedGapIsSaidNotRounded)
{
  const FactorOfSafety F = search(fake_soil(1.75, 0.3));
  EXPECT_FALSE(F.complete);
  EXPECT_NE(F.reason.find("undecided"), std::string::npos) << F.reason;
}

TEST(StrengthReduction, SoilThatNeverFailsIsSaidSo)
{
  const FactorOfSafety F = search(fake_soil(1e9));
  EXPECT_FALSE(F.complete);
  EXPECT_FALSE(F.factor().has_value());
  EXPECT_NE(F.reason.find("stands even at 20"), std::string::npos) << F.reason;
}

TEST(StrengthReduction, StoppingKeepsWhatIsKnown)
{
  StopsAtOnce observer;
  int calls = 0;
  const RunTrial soil = [&](double factor, Observer& o)
  {
    Trial trial = fake_soil(1.6)(factor, o);
    trial.interrupted = ++calls == 3;
    if (trial.interrupted)
      trial.outcome = Outcome::undecided;
    return trial;
  };
  const FactorOfSafety F = reduce_strength(soil, {}, observer);
  EXPECT_EQ(calls, 3);
  EXPECT_FALSE(F.complete);
  EXPECT_NE(F.reason.find("stopped"), std::string::npos);
  EXPECT_TRUE(F.factor().has_value()); // of the two trials before
}
} // namespace berm::sph
