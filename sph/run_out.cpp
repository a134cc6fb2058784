// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/run_out.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace berm::sph
{
namespace
{
constexpr double still_energy = 1e-4;   // of what was dissipated: less counts as still
constexpr double moved_distance = 0.01; // over H: soil that moved or rose by more counts as moved
constexpr long steps_between_polls = 100;

/// The energies so far: what a solver counts from its own start is added to that of the frame.
Energies added(const Energies& before, Energies now)
{
  now.water += before.water;
  now.shake += before.shake;
  now.plastic += before.plastic;
  now.viscous += before.viscous;
  now.damping += before.damping;
  return now;
}

/// Whether nothing has moved for a time.
bool rested(const Frame& frame, double time)
{
  return frame.still_since >= 0 && frame.time - frame.still_since >= time;
}

double dissipated(const Energies& e)
{
  return e.plastic + e.viscous + e.damping;
}

/// Whether the soil is at rest between two frames but for elastic swinging: what moves is small,
/// and so is what is dissipated. docs/theory.md eq. (11.1).
/// @param[in] weight_height  Weight of the soil times the section's height [J per m run].
bool still(const Frame& a, const Frame& b, double fall_time, double weight_height)
{
  const double lost = dissipated(b.energies) - dissipated(a.energies);
  const double scale = std::max(dissipated(b.energies), 0.01 * weight_height);
  return b.energies.kinetic + lost * fall_time / (b.time - a.time) < still_energy * scale;
}

/// Advance to a time since the start of the run-out; false if the user asked to stop.
bool advance_to(UpdatedLagrangian& soil, double start, double end, Observer& observer)
{
  while (start + soil.time() < end)
  {
    if (observer.stop_requested())
      return false;
    const double left = (end - start - soil.time()) / soil.time_step();
    soil.advance(std::clamp(static_cast<long>(left), 1L, steps_between_polls));
  }
  return true;
}

/// Points of the surface that the soil would have if it were packed in upright strips.
/// Every particle's volume is spread over x by a hat of half-width 2 dx, mirrored at the sides: the
/// volume is kept, and the surface is known to less than the spacing. docs/theory.md eq. (11.3).
Polyline surface_of(const Particles& particles, const std::vector<double>& x,
                    const MovingWalls& walls)
{
  const double dx = particles.spacing, width = 2 * dx;
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  const double left = std::floor(*least / dx) * dx;
  const auto strips = static_cast<Index>((*most - left) / dx) + 1;
  std::vector<double> thickness(static_cast<std::size_t>(strips));
  const auto spread = [&](double at, double volume)
  {
    const auto first = static_cast<Index>(std::floor((at - width - left) / dx - 0.5));
    for (Index s = std::max(first, 0); s < std::min(first + 6, strips); ++s)
    {
      const double off = std::abs(left + (s + 0.5) * dx - at);
      thickness[static_cast<std::size_t>(s)] += volume * std::max(1 - off / width, 0.0) / width;
    }
  };
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    spread(x[i], particles.volume[i]);
    if (walls.left)
      spread(2 * *walls.left - x[i], particles.volume[i]);
    if (walls.right)
      spread(2 * *walls.right - x[i], particles.volume[i]);
  }
  Polyline surface;
  for (Index s = 0; s < strips; ++s)
  {
    const double at = left + (s + 0.5) * dx;
    const double base = walls.base.empty() ? 0 : base_line(walls, at).at(at);
    surface.emplace_back(at, base + thickness[static_cast<std::size_t>(s)]);
  }
  return surface;
}

double highest(const Polyline& line)
{
  return std::max_element(line.begin(), line.end(),
                          [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); })
      ->y();
}

/// Foot of the slope from the crest to one end of the ground: the vertex farthest below the
/// straight line between these two; the end if none lies below.
Vec2 toe_of(const Polyline& ground, bool right)
{
  Polyline down = ground; // from the crest on that side to the end
  if (!right)
    std::reverse(down.begin(), down.end());
  const double crest_level = highest(ground);
  while (std::any_of(down.begin() + 1, down.end(),
                     [crest_level](const Vec2& p) { return p.y() == crest_level; }))
    down.erase(down.begin());
  const Vec2 chord = down.back() - down.front();
  Vec2 toe = down.back();
  double deepest = 0;
  for (const Vec2& p : down)
  {
    const Vec2 to = p - down.front();
    const double below = (right ? -1 : 1) * (chord.x() * to.y() - chord.y() * to.x());
    if (below > deepest)
    {
      deepest = below;
      toe = p;
    }
  }
  return toe;
}

/// The farthest point, seen in the direction of motion, at which `now` stands higher than `before`
/// by a height. Both have a point in the middle of each strip that holds soil.
std::optional<Vec2> tip_of(const Polyline& before, const Polyline& now, double height, bool right)
{
  const double dx = now.size() > 1 ? now[1].x() - now[0].x() : 0;
  const auto rise = [&](std::size_t k)
  {
    const double at = (now[k].x() - before.front().x()) / dx;
    const long b = std::lround(at);
    const bool there = b >= 0 && b < static_cast<long>(before.size());
    return there ? now[k].y() - before[static_cast<std::size_t>(b)].y() : INFINITY;
  };
  const std::size_t n = now.size();
  for (std::size_t m = 0; m < n; ++m)
  {
    const std::size_t k = right ? n - 1 - m : m;
    const double here = rise(k);
    if (here <= height)
      continue;
    const std::size_t outer = right ? k + 1 : k - 1; // wraps past the last strip
    if (outer >= n || !std::isfinite(here))
      return now[k];
    const double part = (here - height) / (here - rise(outer));
    return Vec2{now[k] + part * (now[outer] - now[k])};
  }
  return std::nullopt;
}
} // namespace

Moment moment_of(const Frame& frame)
{
  Moment m{.time = frame.time, .energies = frame.energies};
  for (std::size_t i = 0; i < frame.state.ux.size(); ++i)
    m.max_displacement =
        std::max(m.max_displacement, std::hypot(frame.state.ux[i], frame.state.uy[i]));
  return m;
}

Frame first_frame(const MovingBody& body, const State& start)
{
  const UpdatedLagrangian soil(body, {}, start);
  return {
      .state = soil.state(), .pore_pressure = soil.pore_pressure(), .energies = soil.energies()};
}

RunOut run_out(const MovingBody& body, const std::vector<Cone>& cones, const Frame& first,
               double height, const RunOutSettings& settings, FrameStore& frames,
               Observer& observer)
{
  const Stopwatch watch;
  const double g = body.settings.gravity;
  const double fall_time = std::sqrt(height / g);
  const double interval = settings.frame_interval > 0 ? settings.frame_interval : fall_time / 2;
  const double longest = settings.longest > 0 ? settings.longest : 40 * fall_time;

  double weight_height = 0;
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    weight_height += body.particles.volume[i] * body.particles.density[i] * g * height;

  RunOut result;
  Frame frame = first;
  if (std::optional<FrameStore::Kept> kept = frames.kept())
  {
    frame = std::move(kept->last);
    result.history = std::move(kept->history);
  }
  else
  {
    result.history.push_back(moment_of(frame));
    frames.keep(frame);
  }
  result.at_rest = rested(frame, fall_time);
  while (!result.at_rest && frame.time < longest * (1 - 1e-9))
  {
    UpdatedLagrangian soil(body, cones, frame.state, frame.time_step);
    const double end = std::min((frame.number + 1) * interval, longest);
    bool go_on = true;
    if (frame.time < settings.shake_duration)
    {
      soil.set_shake(settings.shake);
      go_on = advance_to(soil, frame.time, std::min(end, settings.shake_duration), observer);
      if (frame.time + soil.time() >= settings.shake_duration)
        soil.set_shake(0);
    }
    go_on = go_on && advance_to(soil, frame.time, end, observer);
    if (!go_on)
    {
      result.interrupted = true;
      break;
    }
    soil.check_finite();
    Frame next{.number = frame.number + 1,
               .time = frame.time + soil.time(),
               .time_step = soil.time_step(),
               .still_since = frame.still_since,
               .steps = frame.steps + soil.steps(),
               .state = soil.state(),
               .pore_pressure = soil.pore_pressure(),
               .energies = added(frame.energies, soil.energies())};
    if (next.time <= settings.shake_duration || !still(frame, next, fall_time, weight_height))
      next.still_since = -1;
    else if (next.still_since < 0)
      next.still_since = frame.time;
    frame = std::move(next);
    result.history.push_back(moment_of(frame));
    frames.keep(frame);
    result.at_rest = rested(frame, fall_time);
    observer.progress(frame.time / longest, {});
  }
  result.time = frame.time;
  result.steps = frame.steps;
  result.time_to_rest = result.at_rest ? frame.still_since : 0;
  // Of the frame, which is all there is when a run goes on after its last one.
  result.closest_pair =
      UpdatedLagrangian(body, cones, frame.state, frame.time_step).closest_pair();
  result.last = std::move(frame);
  result.seconds = watch.elapsed();
  return result;
}

FinalShape final_shape(const Particles& particles, const State& state,
                       const meshes::Section& section)
{
  FinalShape shape;
  const MovingWalls walls = moving_walls(section);
  const double height = section.y_max - section.y_min;
  std::vector<double> start = state.x;
  double to_the_right = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    start[i] -= state.ux[i];
    const double moved = std::hypot(state.ux[i], state.uy[i]);
    shape.max_displacement = std::max(shape.max_displacement, moved);
    if (moved <= moved_distance * height)
      continue;
    shape.moved_volume += particles.volume[i];
    to_the_right += particles.volume[i] * state.ux[i];
  }
  shape.surface = surface_of(particles, state.x, walls);
  const Polyline before = surface_of(particles, start, walls);
  shape.crest_settlement = highest(before) - highest(shape.surface);
  if (shape.moved_volume > 0)
  {
    const bool right = to_the_right > 0;
    shape.side = right ? "right" : "left";
    shape.toe = toe_of(section.ground, right);
    shape.tip = tip_of(before, shape.surface, moved_distance * height, right);
    if (shape.tip)
      shape.run_out = (right ? 1 : -1) * (shape.tip->x() - shape.toe->x());
  }
  return shape;
}
} // namespace berm::sph
