// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/planar_graph.h"

#include "meshes/planar.h"

#include <algorithm>
#include <map>
#include <utility>

namespace berm::meshes
{
namespace
{
/// Whether the border of zone z can be seen at p: inside the section and under no later zone.
bool visible(const Section& section, std::size_t z, const Vec2& p, double tolerance)
{
  if (!polygon_contains(section.outline, p) ||
      nearest_edge(section.outline, p).distance <= tolerance)
    return false;
  for (std::size_t k = z + 1; k < section.zones.size(); ++k)
  {
    const Polyline& cover = section.zones[k].polygon;
    if (polygon_contains(cover, p) && nearest_edge(cover, p).distance > tolerance)
      return false;
  }
  return true;
}

class Cutter
{
public:
  explicit Cutter(const Section& section) : section_(section), points_(section.outline)
  {
    const double size = std::max(section.x_max - section.x_min, section.y_max - section.y_min);
    reach_ = section.zones.empty() ? same_point * size : size;
    for (const Zone& zone : section.zones)
      reach_ = std::min(reach_, healing_reach(zone.polygon, size));
    for (const Zone& zone : section.zones)
      for (const Vec2& p : zone.polygon)
        index_of(p);
    for (const InnerLine& line : section.inner_lines)
      for (const Vec2& p : line.points)
        index_of(p);
    corners_ = points_;
  }

  PlanarGraph cut()
  {
    for (std::size_t z = 0; z < section_.zones.size(); ++z)
    {
      const Polyline& polygon = section_.zones[z].polygon;
      for (std::size_t e = 0; e < polygon.size(); ++e)
      {
        const std::vector<std::size_t> way = cut_edge(polygon[e], polygon[next(e, polygon.size())]);
        for (std::size_t c = 0; c + 1 < way.size(); ++c)
          if (visible(section_, z, 0.5 * (points_[way[c]] + points_[way[c + 1]]), reach_))
            stretch_of_.try_emplace(std::minmax(way[c], way[c + 1]), -1);
      }
    }
    for (const InnerLine& line : section_.inner_lines)
      cut_inner_line(line);
    PlanarGraph graph{.points = std::move(points_), .inside = {}};
    for (const auto& [ends, stretch] : stretch_of_)
      graph.inside.push_back({ends.first, ends.second, stretch});
    return graph;
  }

private:
  std::size_t index_of(const Vec2& p)
  {
    std::size_t best = points_.size();
    double best_distance = reach_;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (const double d = (points_[i] - p).norm(); d <= best_distance)
      {
        best = i;
        best_distance = d;
      }
    if (best == points_.size())
      points_.push_back(p);
    return best;
  }

  /// Points along the segment, its ends included.
  std::vector<std::size_t> cut_edge(const Vec2& a, const Vec2& b)
  {
    std::vector<std::pair<double, std::size_t>> cuts;
    const auto cut_at = [&](const Vec2& p)
    { cuts.emplace_back(nearest_parameter(p, a, b), index_of(p)); };
    for (const Vec2& p : corners_)
      if (distance(p, a, b) <= reach_)
        cut_at(p);
    const auto cut_by = [&](const Polyline& other, std::size_t edges)
    {
      for (std::size_t k = 0; k < edges; ++k)
        if (const auto p = crossing(a, b, other[k], other[next(k, other.size())]))
          cut_at(*p);
    };
    cut_by(section_.outline, section_.outline.size());
    for (const Zone& other : section_.zones)
      cut_by(other.polygon, other.polygon.size());
    for (const InnerLine& other : section_.inner_lines)
      cut_by(other.points, other.points.size() - 1);
    std::sort(cuts.begin(), cuts.end());
    std::vector<std::size_t> way;
    for (const auto& [t, i] : cuts)
      if (way.empty() || way.back() != i)
        way.push_back(i);
    return way;
  }

  /// A single edge between two tips would have the same nodes on both sides: it gets a middle.
  void cut_inner_line(const InnerLine& line)
  {
    std::vector<std::size_t> way;
    for (std::size_t k = 0; k + 1 < line.points.size(); ++k)
      for (const std::size_t i : cut_edge(line.points[k], line.points[k + 1]))
        if (way.empty() || way.back() != i)
          way.push_back(i);
    if (way.size() == 2)
      way.insert(way.begin() + 1, index_of(0.5 * (points_[way[0]] + points_[way[1]])));
    for (std::size_t c = 0; c + 1 < way.size(); ++c)
    {
      const auto ends = std::minmax(way[c], way[c + 1]);
      stretch_of_.insert_or_assign({ends.first, ends.second}, line.stretch);
    }
  }

  const Section& section_;
  Polyline points_, corners_;
  double reach_ = 0; ///< points closer than this are one [m]
  std::map<std::pair<std::size_t, std::size_t>, Index> stretch_of_; ///< -1 for a zone border
};
} // namespace

PlanarGraph planar_graph(const Section& section)
{
  return Cutter(section).cut();
}
} // namespace berm::meshes
