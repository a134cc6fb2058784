// SPDX-License-Identifier: GPL-3.0-or-later
/// From which measure, and when, can it be known whether a slope stands? Rows F-1 to F-7 at three
/// spacings, trials around the knee run on to a certain end, and every measure of every window held
/// against that end. The tables and the figure of docs/theory.md section 6.
/// Usage: bench_verdict [courses.json [part of a row's name]]
#include "sph/verdict.h"
#include "core/error.h"
#include "sph/neighbours.h"
#include "tests/support/published_slopes.h"
#include "tests/support/settled_slope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace
{
using namespace berm;

// A certain end. Nothing here is known to the verdict.
constexpr double rest = 1e-4;       // s at which settling ends, too: a tenth of "stands"
constexpr double far_gone = 8;      // [d_ref]
constexpr double end_of_time = 240; // [T0]
constexpr double creep_to_rest =
    1e-3; // s at that end: falling like 1/t, it goes on for d_ref / 2 in ten times as long

enum Measure
{
  velocity,
  displacement,
  growth,
  energy,
  plastic_growth,
  connection,
  measures
};
constexpr std::array<const char*, measures> names = {"velocity s",
                                                     "largest displacement / d_ref",
                                                     "its growth in a window / d_ref",
                                                     "kinetic / elastic energy",
                                                     "growth of plastic strain in a window",
                                                     "height of the connected zone"};

/// What one window of T0 shows, each measure without a unit, and greater the more the soil fails.
using Window = std::array<double, measures>;

/// One trial, run to its end.
struct Course
{
  std::string row;
  double particles_over_height = 0; ///< H / dx
  double nearness = 0;              ///< factor of the trial over F, less one
  std::vector<Window> windows;
  std::optional<bool> failed; ///< nothing: neither at rest nor far gone at the end of time
  sph::Outcome verdict = sph::Outcome::undecided;
  std::size_t verdict_after = 0; ///< windows
  std::string reason;
};

double energy_ratio(const tests::SettledSlope& slope, const sph::State& now)
{
  double kinetic = 0, elastic = 0;
  for (std::size_t i = 0; i < slope.particles.size(); ++i)
  {
    const sph::Elastic& e = slope.discretisation.elastic[0];
    const double i1 = I1(now.stress[i]), V = slope.particles.volume[i];
    kinetic +=
        0.5 * slope.particles.density[i] * V * (now.vx[i] * now.vx[i] + now.vy[i] * now.vy[i]);
    elastic += V * (J2(now.stress[i]) / (2 * e.G) + i1 * i1 / (18 * e.K));
  }
  return kinetic / elastic;
}

/// Ground's height above the particle, by the highest corner of its column.
double ground_at(const Polyline& ground, double x)
{
  double y = -std::numeric_limits<double>::max();
  for (std::size_t k = 0; k + 1 < ground.size(); ++k)
    if (const Vec2 a = ground[k], b = ground[k + 1]; x >= a.x() && x <= b.x() && b.x() > a.x())
      y = std::max(y, a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y()));
  return y;
}

/// The plastically active zone: particles whose plastic strain grows by more than a tenth of what
/// it grows by where it does so fastest, flooded from neighbour to neighbour.
class ActiveZone
{
public:
  explicit ActiveZone(const tests::SettledSlope& slope)
      : slope_(slope), near_(sph::find_neighbours(slope.particles.x, slope.particles.y,
                                                  static_cast<Index>(slope.particles.size()),
                                                  1.6 * slope.particles.spacing))
  {
    // The uppermost two particles, and those beside a vertical step.
    const sph::Particles& p = slope.particles;
    const double reach = 2 * p.spacing;
    for (std::size_t i = 0; i < p.size(); ++i)
    {
      const double lowest = std::min({ground_at(slope.section.ground, p.x[i]),
                                      ground_at(slope.section.ground, p.x[i] - reach),
                                      ground_at(slope.section.ground, p.x[i] + reach)});
      at_ground_.push_back(p.y[i] > lowest - reach ||
                           p.y[i] > ground_at(slope.section.ground, p.x[i]) - reach);
    }
  }

  /// Height between the highest and the lowest place at which one connected zone meets the ground,
  /// over that of the slope.
  double connected_height(const std::vector<double>& before, const std::vector<double>& now,
                          double height)
  {
    const std::size_t n = now.size();
    double fastest = 0;
    for (std::size_t i = 0; i < n; ++i)
      fastest = std::max(fastest, now[i] - before[i]);
    std::vector<char> active(n);
    for (std::size_t i = 0; i < n; ++i)
      active[i] = fastest > 0 && now[i] - before[i] > 0.1 * fastest;
    double most = 0;
    for (std::size_t start = 0; start < n; ++start)
      if (active[start])
      {
        double low = std::numeric_limits<double>::max(), high = -low;
        std::vector<std::size_t> front = {start};
        active[start] = false;
        while (!front.empty())
        {
          const std::size_t i = front.back();
          front.pop_back();
          if (at_ground_[i])
          {
            low = std::min(low, slope_.particles.y[i]);
            high = std::max(high, slope_.particles.y[i]);
          }
          for (const Index jj : near_.of(static_cast<Index>(i)))
            if (const auto j = static_cast<std::size_t>(jj); active[j])
            {
              active[j] = false;
              front.push_back(j);
            }
        }
        most = std::max(most, (high - low) / height);
      }
    return most;
  }

private:
  const tests::SettledSlope& slope_;
  sph::NeighbourList near_;
  std::vector<char> at_ground_;
};

/// @param[in] strain_unit  gamma H / E: strain under the own weight [-]
void run_on(Course& course, const tests::SettledSlope& slope, double factor, double height)
{
  const auto& model = slope.model;
  const auto soil = model.solver(slope.cones(factor), slope.state);
  ActiveZone zone(slope);
  sph::Verdict verdict;
  sph::State before = slope.state;
  const double unit = model.d_ref / slope.discretisation.height;
  const double volume = tests::total(slope.particles.volume);
  bool judged = false;
  for (double time = 1; !course.failed && time <= end_of_time; ++time)
  {
    constexpr int samples = 16;
    double sum = 0;
    for (int k = 0; k < samples; ++k)
    {
      soil->advance(std::max(1L, std::lround(model.T0 / soil->time_step() / samples)));
      sum += soil->v_rms();
    }
    sph::State now = soil->state();
    Window w;
    w[velocity] = sum / samples * model.T0 / model.d_ref;
    w[displacement] = soil->max_displacement() / model.d_ref;
    w[growth] =
        w[displacement] - (course.windows.empty() ? 0 : course.windows.back()[displacement]);
    w[energy] = energy_ratio(slope, now);
    w[plastic_growth] = 0;
    for (std::size_t i = 0; i < now.plastic_strain.size(); ++i)
      w[plastic_growth] += (now.plastic_strain[i] - before.plastic_strain[i]) *
                           slope.particles.volume[i] / volume / unit;
    w[connection] = zone.connected_height(before.plastic_strain, now.plastic_strain, height);
    course.windows.push_back(w);
    before = std::move(now);
    if (!judged)
    {
      judged = verdict.add_window(time, w[velocity], w[displacement]);
      course.verdict_after = course.windows.size();
    }
    if (time >= 8 && w[velocity] < (time < end_of_time ? rest : creep_to_rest))
      course.failed = false;
    else if (w[displacement] > far_gone && w[velocity] > 4e-3)
      course.failed = true;
  }
  course.verdict = verdict.outcome();
  course.reason = verdict.reason();
}

std::vector<Course> courses_of(const tests::PublishedSlope& row, double particles_over_height)
{
  coupling::Case at_spacing = row.at_one_metre;
  at_spacing.sph.spacing = row.height / particles_over_height;
  const tests::SettledSlope slope(at_spacing);
  const sph::FactorOfSafety F = slope.factor_of_safety({.lower = 0.8 * row.reference,
                                                        .upper = 1.2 * row.reference,
                                                        .tolerance = 0.0015 * row.reference});
  std::vector<Course> courses;
  if (!F.factor())
  {
    std::printf("| %s | %g | %s |\n", row.name.c_str(), particles_over_height, F.reason.c_str());
    return courses;
  }
  for (const double percent : {-5., -2., -1., -.5, -.25, .25, .5, 1., 2., 5.})
  {
    Course& c = courses.emplace_back();
    c.row = row.name;
    c.particles_over_height = particles_over_height;
    c.nearness = percent / 100;
    run_on(c, slope, *F.factor() * (1 + c.nearness), row.height);
  }
  const auto end = [](const Course& c) { return !c.failed ? "c" : *c.failed ? "F" : "s"; };
  const auto say = [](const Course& c)
  {
    return c.verdict == sph::Outcome::undecided ? "u"
           : c.verdict == sph::Outcome::fails   ? "F"
                                                : "s";
  };
  std::string ends, verdicts, after;
  for (const Course& c : courses)
  {
    ends += end(c);
    verdicts += say(c);
    after += fmt::format(" {}", c.verdict_after);
  }
  std::printf("| %s | %g | %zu | %.3f | %s | %s |%s |\n", row.name.c_str(), particles_over_height,
              slope.particles.size(), *F.factor(), ends.c_str(), verdicts.c_str(), after.c_str());
  std::fflush(stdout);
  return courses;
}

/// How well one number for all rows and spacings tells standing from failing.
struct Separation
{
  double threshold = 0;
  int stood_above = 0, failed_below = 0;
};

/// The threshold with the fewest errors at a time; a course that has ended keeps its last window.
Separation separate(const std::vector<const Course*>& clear, Measure m, std::size_t time)
{
  std::vector<std::pair<double, bool>> values;
  for (const Course* c : clear)
    values.emplace_back(c->windows[std::min(time, c->windows.size()) - 1][m], *c->failed);
  std::sort(values.begin(), values.end());
  const auto stood = static_cast<int>(
      std::count_if(values.begin(), values.end(), [](const auto& v) { return !v.second; }));
  Separation best{.threshold = 0, .stood_above = stood, .failed_below = 0};
  Separation s = best;
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    values[k].second ? ++s.failed_below : --s.stood_above;
    if (k + 1 < values.size() && values[k + 1].first == values[k].first)
      continue;
    s.threshold =
        k + 1 < values.size() ? 0.5 * (values[k].first + values[k + 1].first) : values[k].first;
    if (s.stood_above + s.failed_below < best.stood_above + best.failed_below)
      best = s;
  }
  return best;
}

void write_courses(const std::vector<Course>& courses, const char* path)
{
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr)
    throw IoError(fmt::format("cannot write {}", path));
  fmt::print(file, "{{\"rest\": {}, \"far_gone\": {}, \"courses\": [", rest, far_gone);
  for (std::size_t k = 0; k < courses.size(); ++k)
  {
    const Course& c = courses[k];
    fmt::print(file,
               "{}\n{{\"row\": \"{}\", \"H_over_dx\": {}, \"nearness\": {}, \"end\": \"{}\", "
               "\"verdict\": \"{}\", \"after\": {}, \"reason\": \"{}\", \"windows\": [",
               k > 0 ? "," : "", c.row, c.particles_over_height, c.nearness,
               !c.failed   ? "creeps"
               : *c.failed ? "fails"
                           : "stands",
               sph::to_string(c.verdict), c.verdict_after, c.reason);
    for (std::size_t t = 0; t < c.windows.size(); ++t)
    {
      fmt::print(file, "{}[", t > 0 ? "," : "");
      for (std::size_t m = 0; m < measures; ++m)
        fmt::print(file, "{}{:.4g}", m > 0 ? "," : "", c.windows[t][m]);
      fmt::print(file, "]");
    }
    fmt::print(file, "]}}");
  }
  fmt::print(file, "\n]}}\n");
  std::fclose(file);
}

void print_separations(const std::vector<const Course*>& clear)
{
  constexpr std::array<std::size_t, 4> times = {8, 16, 32, 64};
  std::printf(
      "\nErrors of the best threshold, %zu trials with a clear end: stood above it + failed "
      "below it\n| measure |",
      clear.size());
  for (const std::size_t t : times)
    std::printf(" %zu T0 |", t);
  std::printf("\n|--|--|--|--|--|\n");
  for (int m = 0; m < measures; ++m)
  {
    std::printf("| %s |", names[static_cast<std::size_t>(m)]);
    for (const std::size_t t : times)
    {
      const Separation s = separate(clear, static_cast<Measure>(m), t);
      std::printf(" %d + %d (%.2g) |", s.stood_above, s.failed_below, s.threshold);
    }
    std::printf("\n");
  }
}

/// Another way to decide that a slope fails; all take s < 1e-3 from 4 T0 on for rest.
struct Rule
{
  std::string name;
  std::function<bool(const std::vector<Window>& so_far)> fails;
};

/// From 7 T0 on.
Rule farther_than(double limit)
{
  return {fmt::format("moved by {:g} d_ref, moves on", limit), [limit](const std::vector<Window>& w)
          {
            return w.size() >= 7 && w.back()[displacement] > limit && w.back()[velocity] > 4e-3 &&
                   w.back()[growth] > w.back()[velocity];
          }};
}

/// A measure grows by a factor over its smallest value since 7 T0; or 4 d_ref.
Rule grows(Measure m, double factor)
{
  return {fmt::format("{} grows by {:g} %, or 4 d_ref", names[m], 100 * (factor - 1)),
          [=](const std::vector<Window>& w)
          {
            double smallest = std::numeric_limits<double>::max();
            for (std::size_t t = 6; t < w.size(); ++t)
              smallest = std::min(smallest, w[t][m]);
            return w.size() >= 7 && w.back()[velocity] > 4e-3 &&
                   (w.back()[m] > factor * smallest || w.back()[displacement] > 4);
          }};
}

/// The same for s, or three windows above 2e-2 that do not decay by 3 %.
Rule grows_or_does_not_slow_down()
{
  return {"s grows by 5 %, or does not slow down in three windows, or 4 d_ref",
          [by_growth = grows(velocity, 1.05)](const std::vector<Window>& w)
          {
            const std::size_t n = w.size();
            bool undamped = n >= 9;
            for (std::size_t t = n - 3; undamped && t < n; ++t)
              undamped = w[t][velocity] > 2e-2 && w[t][velocity] > 0.97 * w[t - 1][velocity];
            return undamped || by_growth.fails(w);
          }};
}

/// Connected over most of the slope's height in three windows running.
Rule connects()
{
  return {"plastic zone connected in three windows", [](const std::vector<Window>& w)
          {
            const std::size_t n = w.size();
            bool connected = n >= 9 && w.back()[velocity] > 4e-3;
            for (std::size_t t = n - 3; connected && t < n; ++t)
              connected = w[t][connection] > 0.85;
            return connected;
          }};
}

void print_rules(const std::vector<Course>& courses)
{
  std::vector<Rule> rules = {grows_or_does_not_slow_down(), connects()};
  for (const Measure m : {velocity, energy, plastic_growth})
    for (const double factor : {1.05, 1.5, 2.})
      rules.push_back(grows(m, factor));
  for (const double limit : {1., 1.5, 2., 3., 4., 6.})
    rules.push_back(farther_than(limit));
  std::printf(
      "\nFailing rules on the same courses. Wrong: the clear end was another\n| fails if | "
      "stood, called failing | beyond +.5 %% | failed, called standing | undecided | mean T0 "
      "|\n|--|--|--|--|--|--|\n");
  for (const Rule& rule : rules)
  {
    int stood = 0, stood_far = 0, failed = 0, undecided = 0;
    std::size_t windows = 0;
    for (const Course& c : courses)
    {
      std::vector<Window> so_far;
      sph::Outcome outcome = sph::Outcome::undecided;
      for (const Window& w : c.windows)
      {
        so_far.push_back(w);
        if (so_far.size() >= 4 && w[velocity] < 1e-3)
          outcome = sph::Outcome::stands;
        else if (rule.fails(so_far))
          outcome = sph::Outcome::fails;
        else if (so_far.size() >= 160 && w[velocity] < 2e-3)
          outcome = sph::Outcome::stands;
        if (outcome != sph::Outcome::undecided || so_far.size() >= 160)
          break;
      }
      windows += so_far.size();
      undecided += outcome == sph::Outcome::undecided;
      const bool wrong_failure = outcome == sph::Outcome::fails && c.failed == false;
      stood += wrong_failure;
      stood_far += wrong_failure && c.nearness > 0.0051;
      failed += outcome == sph::Outcome::stands && c.failed == true;
    }
    std::printf("| %s | %d | %d | %d | %d | %.1f |\n", rule.name.c_str(), stood, stood_far, failed,
                undecided, static_cast<double>(windows) / static_cast<double>(courses.size()));
  }
}

void print_verdicts(const std::vector<Course>& courses)
{
  std::map<std::string, std::map<std::string, int>> count;
  double verdict_time = 0, end_time = 0;
  for (const Course& c : courses)
  {
    ++count[!c.failed ? "creeps" : *c.failed ? "fails" : "stands"][sph::to_string(c.verdict)];
    verdict_time += static_cast<double>(c.verdict_after);
    end_time += static_cast<double>(c.windows.size());
  }
  std::printf("\n| end | verdict: stands | fails | undecided |\n|--|--|--|--|\n");
  for (auto& [end, verdicts] : count)
    std::printf("| %s | %d | %d | %d |\n", end.c_str(), verdicts["stands"], verdicts["fails"],
                verdicts["undecided"]);
  std::printf("\nverdict after %.0f T0, end after %.0f T0 in the mean\n",
              verdict_time / static_cast<double>(courses.size()),
              end_time / static_cast<double>(courses.size()));
}
} // namespace

int main(int argc, char** argv)
{
  const std::string wanted = argc > 2 ? argv[2] : "";
  std::printf(
      "Trials at F less and plus 5, 2, 1, .5, .25 %%, from the weakest reduction to the "
      "strongest: s stands, F fails, c creeps on at %g T0, u undecided\n"
      "| row | H/dx | particles | F | end | verdict | after, T0 |\n|--|--|--|--|--|--|--|\n",
      end_of_time);
  std::vector<Course> courses;
  for (const tests::PublishedSlope& row : tests::published_slopes())
    for (const double particles_over_height : {10., 20., 40.})
      if (row.name.find(wanted) != std::string::npos)
        for (Course& c : courses_of(row, particles_over_height))
          courses.push_back(std::move(c));
  std::vector<const Course*> clear;
  for (const Course& c : courses)
    if (c.failed)
      clear.push_back(&c);
  if (argc > 1)
    write_courses(courses, argv[1]);
  if (clear.empty())
    return 1;
  print_separations(clear);
  print_rules(courses);
  print_verdicts(courses);
  return 0;
}
