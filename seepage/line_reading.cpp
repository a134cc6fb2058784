// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/line_reading.h"

#include "core/error.h"
#include "meshes/planar.h"
#include "meshes/triangle_locator.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>

namespace berm::seepage
{
namespace
{
constexpr double largest_shift = 1e-4;   ///< of the mesh's extent: marked lines may lie so far off
constexpr double same_parameter = 1e-12; ///< of a position along a segment: rounding

/// Flux and gradient at the nodes, one pair for each kind of triangle around a node.
class NodalMeans
{
public:
  explicit NodalMeans(const Solution& solution) : solution_(solution)
  {
    const meshes::TriangleMesh& mesh = solution.mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      const auto x = [&](std::size_t k) -> const Vec2&
      { return mesh.nodes[static_cast<std::size_t>(mesh.triangles[t][k])]; };
      const double area = meshes::cross(x(1) - x(0), x(2) - x(0)) / 2;
      Vec2 gradient(0, 0); // of the linear head
      for (std::size_t k = 0; k < 3; ++k)
      {
        const Vec2 opposite = x((k + 2) % 3) - x((k + 1) % 3);
        gradient += head(t, k) / (2 * area) * Vec2(-opposite.y(), opposite.x());
      }
      for (const Index node : mesh.triangles[t])
      {
        Mean& mean = means_[key(t, node)];
        mean.area += area;
        mean.flux += area * solution.flux[t];
        mean.gradient += area * gradient;
      }
    }
  }

  struct Mean
  {
    double area = 0;
    Vec2 flux{0, 0}, gradient{0, 0};
  };
  [[nodiscard]] Mean at(const meshes::TriangleLocator::Location& where) const
  {
    Mean result;
    const auto t = static_cast<std::size_t>(where.triangle);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Mean& mean = means_.at(key(t, solution_.mesh.triangles[t][k]));
      result.flux += where.weight[k] / mean.area * mean.flux;
      result.gradient += where.weight[k] / mean.area * mean.gradient;
    }
    return result;
  }

private:
  [[nodiscard]] double head(std::size_t t, std::size_t k) const
  {
    return solution_.head[static_cast<std::size_t>(solution_.mesh.triangles[t][k])];
  }
  /// Node, soil, and whether all of the triangle is wet.
  [[nodiscard]] std::uint64_t key(std::size_t t, Index node) const
  {
    const bool wet =
        std::ranges::all_of(solution_.mesh.triangles[t], [&](Index i)
                            { return solution_.pore_pressure[static_cast<std::size_t>(i)] >= 0; });
    const auto soil = static_cast<std::uint64_t>(solution_.mesh.triangle_soil[t]);
    return (static_cast<std::uint64_t>(node) << 32) | (soil << 1) | (wet ? 1 : 0);
  }

  const Solution& solution_;
  std::unordered_map<std::uint64_t, Mean> means_;
};

/// Finds points of the line in the mesh and reads nodal fields there.
class Reader
{
public:
  explicit Reader(const Solution& solution) : solution_(solution), locator_(solution.mesh)
  {
    const auto [left, right] = std::ranges::minmax(solution.mesh.nodes, {}, &x);
    const auto [low, high] = std::ranges::minmax(solution.mesh.nodes, {}, &y);
    shift_ = largest_shift * std::max(x(right) - x(left), y(high) - y(low));
  }

  [[nodiscard]] meshes::TriangleLocator::Location locate(const Vec2& point) const
  {
    const auto where = locator_.locate(point, shift_);
    if (where.triangle < 0)
      throw NumericalError(fmt::format("a line leaves the seepage mesh at ({:.6g}, {:.6g}) m",
                                       point.x(), point.y()));
    return where;
  }
  [[nodiscard]] double value(std::span<const double> nodal,
                             const meshes::TriangleLocator::Location& where) const
  {
    double value = 0;
    for (std::size_t k = 0; k < 3; ++k)
      value += where.weight[k] * nodal[static_cast<std::size_t>(node(where.triangle, k))];
    return value;
  }

private:
  static double x(const Vec2& p) { return p.x(); }
  static double y(const Vec2& p) { return p.y(); }
  [[nodiscard]] Index node(Index triangle, std::size_t k) const
  {
    return solution_.mesh.triangles[static_cast<std::size_t>(triangle)][k];
  }

  const Solution& solution_;
  meshes::TriangleLocator locator_;
  double shift_ = 0;
};

/// Positions on segment a-b, 0 to 1, between which a linear field has no kink: where it meets an
/// edge of the mesh. Cost O(m).
std::vector<double> kinks(const meshes::TriangleMesh& mesh, const Vec2& a, const Vec2& b)
{
  std::vector<double> at{0, 1};
  const Vec2 ab = b - a;
  for (const auto& triangle : mesh.triangles)
  {
    std::array<double, 3> side{}; // of the segment's line on which each corner lies
    for (std::size_t k = 0; k < 3; ++k)
      side[k] = meshes::cross(ab, mesh.nodes[static_cast<std::size_t>(triangle[k])] - a);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t l = (k + 1) % 3;
      if ((side[k] > 0 && side[l] > 0) || (side[k] < 0 && side[l] < 0) || side[k] == side[l])
        continue;
      const Vec2 &c = mesh.nodes[static_cast<std::size_t>(triangle[k])],
                 &d = mesh.nodes[static_cast<std::size_t>(triangle[l])];
      const Vec2 crossing = c + side[k] / (side[k] - side[l]) * (d - c);
      const double t = (crossing - a).dot(ab) / ab.squaredNorm();
      if (t > 0 && t < 1)
        at.push_back(t);
    }
  }
  std::ranges::sort(at);
  const auto repeated =
      std::unique(at.begin(), at.end(), [](double s, double t) { return t - s < same_parameter; });
  at.erase(repeated, at.end());
  return at;
}

/// Integrals of max(p, 0) and of s max(p, 0) over s = 0 .. length, p linear from p_a to p_b.
struct Moments
{
  double zeroth = 0, first = 0;
};
Moments moments(double p_a, double p_b, double length)
{
  double start = 0, end = length;
  if (p_a <= 0 && p_b <= 0)
    return {};
  if (p_a < 0)
    start = length * p_a / (p_a - p_b);
  if (p_b < 0)
    end = length * p_a / (p_a - p_b);
  p_a = std::max(p_a, 0.0);
  p_b = std::max(p_b, 0.0);
  const double l = end - start;
  const double zeroth = l * (p_a + p_b) / 2;
  return {zeroth, start * zeroth + l * l * (p_a + 2 * p_b) / 6};
}

Vec2 to_the_left(const Vec2& direction)
{
  return Vec2(-direction.y(), direction.x()).normalized();
}

Vec2 point_at(const Polyline& line, double distance)
{
  for (std::size_t k = 1; k < line.size(); ++k)
  {
    const double l = (line[k] - line[k - 1]).norm();
    if (distance <= l || k + 1 == line.size())
      return line[k - 1] + std::min(distance / l, 1.0) * (line[k] - line[k - 1]);
    distance -= l;
  }
  return line.back();
}
/// Segment by segment: length, force, and the water that passes by the flux.
LineReading integrals(const Solution& solution, const Polyline& line, const Reader& reader)
{
  LineReading reading;
  WaterForce& water = reading.water;
  double first_moment = 0;
  for (std::size_t k = 1; k < line.size(); ++k)
  {
    const Vec2 &a = line[k - 1], &b = line[k];
    const Vec2 left = to_the_left(b - a);
    const std::vector<double> at = kinks(solution.mesh, a, b);
    const double length = (b - a).norm();
    Moments sum;
    for (std::size_t i = 1; i < at.size(); ++i)
    {
      const auto pressure = [&](double t)
      { return reader.value(solution.pore_pressure, reader.locate(a + t * (b - a))); };
      const double start = at[i - 1] * length, l = (at[i] - at[i - 1]) * length;
      const Moments part = moments(pressure(at[i - 1]), pressure(at[i]), l);
      sum.zeroth += part.zeroth;
      sum.first += start * part.zeroth + part.first;
      const auto middle = reader.locate(a + (at[i - 1] + at[i]) / 2 * (b - a));
      reading.discharge += l * left.dot(solution.flux[static_cast<std::size_t>(middle.triangle)]);
    }
    // The segment's part acts at sum.first / sum.zeroth from a, to the left.
    water.force += sum.zeroth * left;
    water.moment += meshes::cross(a - line.front(), left) * sum.zeroth + sum.first; // t x left = 1
    water.pressure += sum.zeroth;
    first_moment += reading.length * sum.zeroth + sum.first;
    reading.length += length;
  }
  water.distance = water.pressure > 0 ? first_moment / water.pressure : 0;
  water.at = point_at(line, water.distance);
  return reading;
}

std::vector<LineSample> samples(const Solution& solution, const Line& line, double length,
                                const Reader& reader, const NodalMeans& means)
{
  std::vector<LineSample> list;
  for (int i = 0; i < line.samples; ++i)
  {
    LineSample sample{.distance = length * i / (line.samples - 1)};
    sample.at = point_at(line.points, sample.distance);
    const auto where = reader.locate(sample.at);
    sample.head = reader.value(solution.head, where);
    sample.pore_pressure = reader.value(solution.pore_pressure, where);
    const NodalMeans::Mean mean = means.at(where);
    sample.flux = mean.flux;
    sample.gradient = mean.gradient.norm();
    list.push_back(sample);
  }
  return list;
}
} // namespace

std::vector<LineReading> read_lines(const Solution& solution, const std::vector<Line>& lines)
{
  std::vector<LineReading> readings;
  if (lines.empty())
    return readings;
  const Reader reader(solution);
  const NodalMeans means(solution);
  const bool has_psi = solution.stream_function.size() == solution.mesh.nodes.size();
  for (const Line& line : lines)
  {
    assert(line.points.size() >= 2 && line.samples >= 2);
    LineReading& reading = readings.emplace_back(integrals(solution, line.points, reader));
    reading.by_stream_function = has_psi;
    if (has_psi)
    {
      const auto psi = [&](const Vec2& point)
      { return reader.value(solution.stream_function, reader.locate(point)); };
      reading.discharge = psi(line.points.front()) - psi(line.points.back());
    }
    reading.samples = samples(solution, line, reading.length, reader, means);
  }
  return readings;
}
} // namespace berm::seepage
