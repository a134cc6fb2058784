// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/strength_reduction.h"

#include "core/error.h"
#include "sph/trial_bytes.h"

#include <atomic>
#include <barrier>
#include <cmath>
#include <gtest/gtest.h>
#include <thread>

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
    EXPECT_LE(*F.fails - *F.stands, 0.02);
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
  EXPECT_EQ(trials(1.605, 1.615), 2u);
  EXPECT_EQ(trials(1.595, 1.615), 2u); // one below: its upper end was tried as the lower
  EXPECT_EQ(trials(1.625, 1.615), 3u);
  // Strides of 0.02 that double until they pass the answer, then bisection of the last.
  EXPECT_LE(trials(2.5, 1.6), 2 + 2 * std::ceil(std::log2(1 + 0.9 / 0.02)));
  EXPECT_LE(trials(0.2, 1.6), 2 + 2 * std::ceil(std::log2(1 + 1.4 / 0.02)));
}

TEST(StrengthReduction, TheBracketDoesNotDependOnRangeAndGuess)
{
  for (const double critical : {0.207, 1.009, 1.631, 4.4499})
  {
    const FactorOfSafety one = search(fake_soil(critical));
    for (const double guess : {0.3, 1.0, 1.63, 2.0, 3.7})
    {
      const FactorOfSafety other = search(fake_soil(critical), {.guess = guess});
      EXPECT_EQ(one.stands, other.stands) << critical << " from " << guess; // every bit
      EXPECT_EQ(one.fails, other.fails) << critical << " from " << guess;
      const FactorOfSafety ranged =
          search(fake_soil(critical), {.lower = guess, .upper = guess + 1});
      EXPECT_EQ(one.stands, ranged.stands) << critical << " from " << guess;
      EXPECT_EQ(one.fails, ranged.fails) << critical << " from " << guess;
    }
  }
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
  const FactorOfSafety F = search(fake_soil(1.7), {.lower = 1, .upper = 3, .tolerance = 1. / 128});
  EXPECT_EQ(F.trials.size(), 7u); // 128 brackets
}

TEST(StrengthReduction, ReachesAFactorFarOutsideItsRangeInAFewTrialsForEachStep)
{
  const FactorOfSafety F = search(fake_soil(34.5), {.tolerance = 0.01, .max_factor = 100});
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

TEST(StrengthReduction, AroundAnUndecidedTrialTheBracketIsTwoStepsWide)
{
  // 1.75 is undecided, wherever the search comes from.
  for (const double guess : {1.2, 1.745, 1.755, 2.4})
  {
    const FactorOfSafety F =
        search(fake_soil(1.75, 0.004), {.tolerance = 1. / 128, .guess = guess});
    EXPECT_TRUE(F.complete) << guess << ": " << F.reason;
    EXPECT_EQ(*F.stands, 1.75 - 1. / 64);
    EXPECT_EQ(*F.fails, 1.75 + 1. / 64);
  }
  // Undecided by chance, well inside what stands.
  const RunTrial soil = [inner = fake_soil(1.9)](double factor, Observer& observer)
  {
    Trial trial = inner(factor, observer);
    if (factor == 1.75)
      trial.outcome = Outcome::undecided;
    return trial;
  };
  const FactorOfSafety F = search(soil, {.tolerance = 1. / 128});
  EXPECT_TRUE(F.complete) << F.reason;
  EXPECT_LE(*F.stands, 1.9);
  EXPECT_GE(*F.fails, 1.9);
}

TEST(StrengthReduction, AnUndecidedGapIsMeasuredNotRounded)
{
  for (const double gap : {0.02, 0.03, 0.3})
  {
    const FactorOfSafety F = search(fake_soil(1.75, gap), {.tolerance = 0.01});
    EXPECT_FALSE(F.complete);
    EXPECT_NE(F.reason.find("undecided"), std::string::npos) << F.reason;
    ASSERT_TRUE(F.stands && F.fails);
    EXPECT_LE(*F.stands, 1.75 - gap);
    EXPECT_GE(*F.stands, 1.75 - gap - 0.02); // a step at most
    EXPECT_GE(*F.fails, 1.75 + gap);
    EXPECT_LE(*F.fails, 1.75 + gap + 0.02);
  }
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

namespace
{
/// Ranks as threads of this process.
class ThreadTeam : public Team
{
public:
  struct Shared
  {
    explicit Shared(int n) : texts(static_cast<std::size_t>(n)), barrier(n) {}
    std::vector<std::string> texts;
    std::barrier<> barrier;
  };
  ThreadTeam(Shared& shared, int rank) : shared_(shared), rank_(rank) {}
  [[nodiscard]] int size() const override { return static_cast<int>(shared_.texts.size()); }
  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] std::vector<std::string> gather(std::string mine) override
  {
    shared_.texts[static_cast<std::size_t>(rank_)] = std::move(mine);
    shared_.barrier.arrive_and_wait();
    std::vector<std::string> all = shared_.texts;
    shared_.barrier.arrive_and_wait();
    return all;
  }

private:
  Shared& shared_;
  int rank_;
};

/// Does the work of every rank, each on a thread, and waits for all.
template <class Work>
void on_ranks(int ranks, const Work& work)
{
  ThreadTeam::Shared shared(ranks);
  std::vector<std::jthread> threads;
  for (int rank = 0; rank < ranks; ++rank)
    threads.emplace_back(
        [&, rank]
        {
          ThreadTeam team(shared, rank);
          work(team);
        });
}

/// Runs the search on `ranks` threads. @return Each rank's answer.
std::vector<FactorOfSafety> team_search(const RunTrial& soil, const SearchSettings& settings,
                                        int ranks)
{
  std::vector<FactorOfSafety> answers(static_cast<std::size_t>(ranks));
  on_ranks(ranks,
           [&](Team& team)
           {
             Observer silent;
             answers[static_cast<std::size_t>(team.rank())] =
                 reduce_strength(soil, settings, silent, team);
           });
  return answers;
}
} // namespace

TEST(TeamSearch, GivesTheSameTrialsForAnyNumberOfRanks)
{
  for (const double critical : {0.21, 1.63, 9.7})
    for (const SearchSettings& settings :
         {SearchSettings{}, SearchSettings{.tolerance = 0.004, .guess = 1.6}})
    {
      const RunTrial soil = fake_soil(critical, 0.0005);
      const FactorOfSafety alone = search(soil, settings);
      for (const int ranks : {2, 3, 5, 8})
        for (const FactorOfSafety& F : team_search(soil, settings, ranks))
        {
          EXPECT_EQ(F.stands, alone.stands);
          EXPECT_EQ(F.fails, alone.fails);
          EXPECT_EQ(F.complete, alone.complete);
          ASSERT_EQ(F.trials.size(), alone.trials.size());
          for (std::size_t i = 0; i < F.trials.size(); ++i)
          {
            EXPECT_EQ(F.trials[i].factor, alone.trials[i].factor);
            EXPECT_EQ(F.trials[i].outcome, alone.trials[i].outcome);
            EXPECT_EQ(F.trials[i].state.ux, alone.trials[i].state.ux);
          }
        }
    }
}

TEST(TeamSearch, TakesFewerRoundsTheMoreRanksThereAre)
{
  const auto rounds = [](int ranks)
  {
    std::atomic<int> trials_of_rank_0 = 0;
    on_ranks(ranks,
             [&](Team& team)
             {
               Observer silent;
               const RunTrial soil = [&](double factor, Observer& observer)
               {
                 trials_of_rank_0 += team.rank() == 0;
                 return fake_soil(1.7)(factor, observer);
               };
               (void)reduce_strength(soil, {.lower = 1, .upper = 3, .tolerance = 1. / 128}, silent,
                                     team);
             });
    return trials_of_rank_0.load();
  };
  EXPECT_EQ(rounds(1), 7); // 128 brackets
  EXPECT_EQ(rounds(3), 4); // two bisections a round
  EXPECT_EQ(rounds(7), 3); // three
}

TEST(TeamSearch, AnErrorInATrialIsThrownOnEveryRankOnceTheTrialIsWanted)
{
  const RunTrial soil = [](double factor, Observer& observer)
  {
    if (factor > 1.9)
      throw NumericalError("stress of particle 7 is not finite");
    return fake_soil(1.7)(factor, observer);
  };
  std::atomic<int> thrown = 0;
  on_ranks(2,
           [&](Team& team)
           {
             Observer silent;
             try
             {
               (void)reduce_strength(soil, {.lower = 1, .upper = 3}, silent, team);
             }
             catch (const NumericalError&)
             {
               ++thrown;
             }
           });
  EXPECT_EQ(thrown, 2); // the first middle is 2
  // One that no rank would have wanted alone is no error: 1.25 is only tried ahead.
  const RunTrial bad_below = [](double factor, Observer& observer)
  {
    if (factor < 1.3)
      throw NumericalError("not wanted");
    return fake_soil(1.7)(factor, observer);
  };
  for (const FactorOfSafety& F : team_search(bad_below, {.lower = 1, .upper = 2}, 3))
    EXPECT_TRUE(F.complete) << F.reason;
}

TEST(SearchAhead, TheFirstWantedIsTheNextAndTheOthersFollowFromSuppositions)
{
  const SearchSettings settings{.lower = 1, .upper = 3, .tolerance = 1. / 128};
  EXPECT_EQ(wanted_next(settings, {}, 7),
            (std::vector<double>{2, 2.5, 1.5, 2.75, 2.25, 1.75, 1.25}));
  // With a guess either side of it comes first: a good one needs no more.
  EXPECT_EQ(wanted_next({.tolerance = 1. / 128, .guess = 2.005}, {}, 2),
            (std::vector<double>{2, 2 + 1. / 64}));
  // Nothing is wanted once the bracket is closed.
  FactorOfSafety closed = search(fake_soil(1.7), settings);
  Outcomes known;
  for (const Trial& trial : closed.trials)
    known[trial.factor] = trial.outcome;
  EXPECT_TRUE(wanted_next(settings, known, 4).empty());
}

TEST(TrialBytes, ComeBackAsTheyWent)
{
  Trial trial;
  trial.factor = 1.25;
  trial.outcome = Outcome::fails;
  trial.reason = "moves ever faster";
  trial.history = {{1, 2, 3}, {4, 5, 6}};
  trial.steps = 77;
  trial.interrupted = true;
  trial.seconds = {1.5, 2.5};
  trial.state.ux = {1, 2};
  trial.state.stress = {{1, 2, 3, 4}, {5, 6, 7, 8}};
  trial.state.density = {9};
  const std::string bytes = to_bytes(trial);
  const Trial back = from_bytes<Trial>(bytes);
  EXPECT_EQ(to_bytes(back), bytes);
  EXPECT_EQ(back.reason, trial.reason);
  EXPECT_EQ(back.history[1].max_displacement, 6);
  EXPECT_EQ(back.state.stress[1].xy, 8);
  EXPECT_EQ(back.seconds.cpu, 2.5);
  EXPECT_TRUE(back.state.vx.empty());
}

TEST(TrialBytes, SettledSoilToo)
{
  const Settled settled{.state = {.ux = {1},
                                  .uy = {2},
                                  .vx = {},
                                  .vy = {},
                                  .stress = {{1, 2, 3, 4}},
                                  .plastic_strain = {5}},
                        .settlement = 0.25,
                        .steps = 12};
  const Settled back = from_bytes<Settled>(to_bytes(settled));
  EXPECT_EQ(to_bytes(back), to_bytes(settled));
  EXPECT_EQ(back.steps, 12);
  EXPECT_EQ(back.state.stress[0].zz, 3);
}

TEST(TrialBytes, CutShortAtAnyPlaceTheyAreNone)
{
  Trial trial;
  trial.reason = "at rest";
  trial.history = {{1, 2, 3}};
  trial.state.stress = {{1, 2, 3, 4}};
  const std::string bytes = to_bytes(trial);
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW((void)from_bytes<Trial>(bytes.substr(0, length)), std::length_error) << length;
  // A length that no memory holds.
  std::string wrong = bytes;
  wrong.replace(sizeof trial.factor + sizeof trial.outcome, 8, 8, '\xff');
  EXPECT_THROW((void)from_bytes<Trial>(wrong), std::length_error);
}
} // namespace berm::sph
