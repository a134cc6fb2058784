// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/mechanism.h"

#include "meshes/planar.h"
#include "sph/neighbours.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace berm::sph
{
namespace
{
constexpr double skin_ratio = 0.1;  // thickness over length
constexpr double least_rows = 2;    // of particles in a deep slide
constexpr double near_circle = 0.1; // misfit over thickness
constexpr double flat_arc = 5;      // radius over length: the sagitta is a fortieth of the length

struct Field
{
  std::vector<double> speed, mass;
};

/// Momentum-weighted mean speed: that of the block, whatever the size of the resting part [m/s].
double block_speed(const Field& f)
{
  double momentum = 0, energy = 0;
  for (std::size_t i = 0; i < f.speed.size(); ++i)
  {
    momentum += f.mass[i] * f.speed[i];
    energy += f.mass[i] * f.speed[i] * f.speed[i];
  }
  return momentum > 0 ? energy / momentum : 0;
}

/// Mark the connected part of the moving particles that has the largest momentum.
std::vector<bool> sliding_mass(const Particles& particles, const Field& f, double threshold)
{
  const auto n = static_cast<Index>(particles.size());
  const NeighbourList near = find_neighbours(particles.x, particles.y, n, 1.6 * particles.spacing);
  std::vector<Index> part(particles.size(), -1);
  Index parts = 0, heaviest = -1;
  double largest = 0;
  std::vector<Index> front;
  for (Index seed = 0; seed < n; ++seed)
  {
    const auto s = static_cast<std::size_t>(seed);
    if (part[s] >= 0 || f.speed[s] < threshold)
      continue;
    double momentum = 0;
    front.assign(1, seed);
    part[s] = parts;
    while (!front.empty())
    {
      const Index i = front.back();
      front.pop_back();
      momentum += f.mass[static_cast<std::size_t>(i)] * f.speed[static_cast<std::size_t>(i)];
      for (const Index j : near.of(i))
        if (part[static_cast<std::size_t>(j)] < 0 &&
            f.speed[static_cast<std::size_t>(j)] >= threshold)
        {
          part[static_cast<std::size_t>(j)] = parts;
          front.push_back(j);
        }
    }
    if (momentum > largest)
    {
      largest = momentum;
      heaviest = parts;
    }
    ++parts;
  }
  std::vector<bool> slides(particles.size());
  for (std::size_t i = 0; i < slides.size(); ++i)
    slides[i] = part[i] == heaviest && heaviest >= 0;
  return slides;
}

/// Particles i .. end-1 stand above each other.
struct Column
{
  std::size_t begin, end;
};

std::vector<Column> columns_of(const Particles& particles, const meshes::Section& section)
{
  const auto strip = [&](std::size_t i)
  { return std::floor((particles.x[i] - section.x_min) / particles.spacing); };
  const auto together = [&](std::size_t i, std::size_t j)
  {
    return particles.packing == "columns"
               ? std::abs(particles.x[i] - particles.x[j]) < 0.25 * particles.spacing
               : strip(i) == strip(j);
  };
  std::vector<Column> columns;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= particles.size(); ++i)
    if (i == particles.size() || !together(i, begin))
    {
      columns.push_back({begin, i});
      begin = i;
    }
  return columns;
}

/// Where a value passes a level between two points; the second point if it does not.
double crossing(double at_a, double value_a, double at_b, double value_b, double level)
{
  if (value_a >= level || value_b <= value_a)
    return at_b;
  return at_a + (at_b - at_a) * std::clamp((level - value_a) / (value_b - value_a), 0.0, 1.0);
}

/// The circle of a slip line; nothing where that is nearly straight, bulges upwards, or is some
/// other curve.
std::optional<FittedCircle> slip_circle(const Mechanism& m)
{
  std::optional<FittedCircle> circle = fit_circle(m.slip_line);
  if (!circle || circle->misfit > near_circle * m.thickness ||
      circle->radius > flat_arc * m.length || circle->centre.y() < 0.5 * (m.entry.y() + m.exit.y()))
    return std::nullopt;
  return circle;
}
} // namespace

std::optional<Mechanism> find_mechanism(const Particles& particles, const State& failing,
                                        const meshes::Section& section)
{
  // Step 1: the sliding mass.
  Field f;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    f.speed.push_back(std::hypot(failing.vx[i], failing.vy[i]));
    f.mass.push_back(particles.density[i] * particles.volume[i]);
  }
  const double half = 0.5 * block_speed(f);
  if (half <= 0)
    return std::nullopt;
  const std::vector<bool> slides = sliding_mass(particles, f, half);
  Mechanism m;
  double momentum_x = 0;
  for (std::size_t i = 0; i < slides.size(); ++i)
    if (slides[i])
    {
      m.volume += particles.volume[i];
      momentum_x += f.mass[i] * failing.vx[i];
    }
  m.side = momentum_x > 0 ? "right" : "left";

  // Step 2: its lower border, column by column.
  const std::vector<Column> columns = columns_of(particles, section);
  const auto reaches_ground = [&](const Column& c) { return slides[c.end - 1]; };
  const auto first = std::find_if(columns.begin(), columns.end(), reaches_ground);
  if (first == columns.end())
    return std::nullopt;
  const auto last = std::find_if(columns.rbegin(), columns.rend(), reaches_ground).base() - 1;
  for (auto c = first; c <= last; ++c)
  {
    std::size_t lowest = c->begin;
    while (lowest < c->end && !slides[lowest])
      ++lowest;
    if (lowest == c->end)
      continue;
    const double x = particles.x[lowest];
    const double y = lowest == c->begin ? meshes::base_level(section, x)
                                        : crossing(particles.y[lowest - 1], f.speed[lowest - 1],
                                                   particles.y[lowest], f.speed[lowest], half);
    m.slip_line.push_back({x, y});
    m.depth = std::max(m.depth, meshes::ground_level(section, x) - y);
    m.thickness = std::max(m.thickness, meshes::distance({x, y}, section.ground));
  }

  // Step 3: its ends, on the ground between the outermost moving column and its resting neighbour.
  const auto on_ground = [&](std::vector<Column>::const_iterator moving, std::ptrdiff_t outwards)
  {
    const std::size_t b = moving->end - 1;
    double x = particles.x[b];
    const auto beside = moving - columns.begin() + outwards;
    if (beside >= 0 && beside < static_cast<std::ptrdiff_t>(columns.size()))
    {
      const std::size_t a = columns[static_cast<std::size_t>(beside)].end - 1;
      x = crossing(particles.x[a], f.speed[a], x, f.speed[b], half);
    }
    return Vec2{x, meshes::ground_level(section, x)};
  };
  m.slip_line.insert(m.slip_line.begin(), on_ground(first, -1));
  m.slip_line.push_back(on_ground(last, 1));
  if (m.side == "left")
    std::reverse(m.slip_line.begin(), m.slip_line.end());
  m.entry = m.slip_line.front();
  m.exit = m.slip_line.back();
  m.length = (m.exit - m.entry).norm();
  const double skin = std::max(skin_ratio * m.length, least_rows * particles.spacing);
  m.kind = m.thickness < skin ? "surface skin" : "deep slide";
  m.circle = slip_circle(m);
  return m;
}
} // namespace berm::sph
