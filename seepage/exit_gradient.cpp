// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/exit_gradient.h"

#include "meshes/planar.h"
#include "seepage/boundary.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace berm::seepage
{
namespace
{
constexpr double kept_away_share = 0.02;  ///< of the section's height: how far from a singularity
constexpr double least_outflow = 1e-7;    ///< of the discharge: below, what leaves is rounding
constexpr double straight = 5 * pi / 180; ///< up to this angle a boundary counts as straight [rad]

enum class EdgeState
{
  wet,   ///< the head is given, or held at the ground: water may pass
  dry,   ///< could become wet
  closed ///< the flow is given
};

/// K v: conductivity with turned principal axes, docs/theory.md eq. (2.3).
Vec2 times(const Conductivity& k, const Vec2& v)
{
  const Vec2 x(std::cos(k.angle), std::sin(k.angle)), y(-x.y(), x.x());
  return k.kx * v.dot(x) * x + k.ky * v.dot(y) * y;
}

/// What is known of an outer edge, and what is found at its two ends.
struct Edge
{
  EdgeState state = EdgeState::closed;
  std::size_t from = 0, to = 0; ///< nodes
  Index stretch = 0;
  Edge *before = nullptr, *after = nullptr; ///< the edges that end and start there
  Vec2 tangent{0, 0}, normal{0, 0};         ///< the soil on the left; outwards
  double length = 0;                        ///< [m]
  double slope = 0;                         ///< d head / ds [-]
  Index soil = 0;
  double k_nn = 0, k_nt = 0;     ///< n . K n, n . K t [m/s]
  double at_from = 0, at_to = 0; ///< hydraulic gradient along the normal [-]

  /// Hydraulic gradient where that along the normal is `normal_part`.
  [[nodiscard]] Vec2 gradient(double normal_part) const
  {
    return normal_part * normal - slope * tangent;
  }
  [[nodiscard]] double flux(double normal_part) const { return k_nn * normal_part - k_nt * slope; }
};

/// Angle of the soil between two edges that follow each other [rad].
double soil_angle(const Edge& a, const Edge& b)
{
  return pi - std::atan2(meshes::cross(a.tangent, b.tangent), a.tangent.dot(b.tangent));
}

bool turns(const Edge& a, const Edge& b)
{
  return std::abs(soil_angle(a, b) - pi) > straight;
}

/// Both heads known, less than 180 degrees of soil: the gradient follows from them.
bool is_known(const Edge& a, const Edge& b)
{
  return a.state == EdgeState::wet && b.state == EdgeState::wet && soil_angle(a, b) < pi - straight;
}

/// docs/theory.md eq. (2.23): grad head from its slopes along both edges.
Vec2 known_gradient(const Edge& a, const Edge& b)
{
  const double area = meshes::cross(a.tangent, b.tangent);
  return Vec2(a.slope * b.tangent.y() - b.slope * a.tangent.y(),
              b.slope * a.tangent.x() - a.slope * b.tangent.x()) /
         area;
}

/// Whether the exact gradient has no bound where two edges meet.
bool is_singular(const Edge& a, const Edge& b)
{
  const bool wet_a = a.state == EdgeState::wet, wet_b = b.state == EdgeState::wet;
  const double angle = soil_angle(a, b);
  if (wet_a && wet_b)
    return angle > pi + straight ||
           (angle > pi - straight && std::abs(a.slope - b.slope) > std::sin(straight));
  const bool closed = a.state == EdgeState::closed || b.state == EdgeState::closed;
  return (wet_a || wet_b) && closed && angle > pi / 2 + straight;
}

std::vector<Edge> edges_of(const Solution& solution, std::span<const Boundary> boundary,
                           std::span<const Conductivity> conductivity)
{
  const meshes::TriangleMesh& mesh = solution.mesh;
  const NodeConditions conditions = node_conditions(mesh, boundary);
  const auto is_wet = [&](std::size_t i)
  {
    return conditions.kind[i] == NodeKind::head ||
           (conditions.kind[i] == NodeKind::face && solution.pore_pressure[i] == 0);
  };
  std::vector<Edge*> starting_at(mesh.nodes.size(), nullptr);
  std::vector<Edge> edges(mesh.boundary.size());
  for (std::size_t e = 0; e < edges.size(); ++e)
  {
    Edge& edge = edges[e];
    edge.from = static_cast<std::size_t>(mesh.boundary[e][0]);
    edge.to = static_cast<std::size_t>(mesh.boundary[e][1]);
    edge.stretch = mesh.boundary_stretch[e];
    starting_at[edge.from] = &edge;
    const Vec2 along = mesh.nodes[edge.to] - mesh.nodes[edge.from];
    edge.length = along.norm();
    edge.tangent = along / edge.length;
    edge.normal = {edge.tangent.y(), -edge.tangent.x()};
    edge.slope = (solution.head[edge.to] - solution.head[edge.from]) / edge.length;
    const BoundaryKind kind = boundary[static_cast<std::size_t>(edge.stretch)].kind;
    if (kind == BoundaryKind::head || kind == BoundaryKind::seepage_face)
      edge.state = is_wet(edge.from) && is_wet(edge.to) ? EdgeState::wet : EdgeState::dry;
  }
  for (Edge& edge : edges)
    if (Edge* after = starting_at[edge.to])
    {
      edge.after = after;
      after->before = &edge;
    }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) // the soil along the boundary
    for (std::size_t k = 0; k < 3; ++k)
    {
      Edge* start = starting_at[static_cast<std::size_t>(mesh.triangles[t][k])];
      if (!start || start->to != static_cast<std::size_t>(mesh.triangles[t][(k + 1) % 3]))
        continue;
      Edge& edge = *start;
      edge.soil = mesh.triangle_soil[t];
      const Conductivity& k_sat = conductivity[static_cast<std::size_t>(edge.soil)];
      edge.k_nn = edge.normal.dot(times(k_sat, edge.normal));
      edge.k_nt = edge.normal.dot(times(k_sat, edge.tangent));
    }
  return edges;
}

using Side = std::vector<Edge*>;

/// Wet edges one after the other, up to a place where the gradient is known, or the water's edge.
std::vector<Side> sides_of(std::vector<Edge>& edges)
{
  const auto goes_on = [](const Edge* a, const Edge* b) {
    return a && b && a->state == EdgeState::wet && b->state == EdgeState::wet && !is_known(*a, *b);
  };
  std::vector<Side> sides;
  std::vector<bool> taken(edges.size(), false);
  const auto walk = [&](Edge* edge)
  {
    Side& side = sides.emplace_back();
    side.push_back(edge);
    while (goes_on(edge, edge->after) && edge->after != side.front())
      side.push_back(edge = edge->after);
    for (const Edge* e : side)
      taken[static_cast<std::size_t>(e - edges.data())] = true;
  };
  for (Edge& edge : edges)
    if (edge.state == EdgeState::wet && !goes_on(edge.before, &edge))
      walk(&edge);
  for (Edge& edge : edges) // wet and smooth all round: from anywhere
    if (edge.state == EdgeState::wet && !taken[static_cast<std::size_t>(&edge - edges.data())])
      walk(&edge);
  return sides;
}

/// Solve a symmetric tridiagonal system in place; `right_side` becomes the answer (Thomas).
void solve_tridiagonal(std::vector<double>& diagonal, const std::vector<double>& beside,
                       std::vector<double>& right_side)
{
  const std::size_t n = diagonal.size();
  for (std::size_t i = 1; i < n; ++i)
  {
    const double share = beside[i - 1] / diagonal[i - 1];
    diagonal[i] -= share * beside[i - 1];
    right_side[i] -= share * right_side[i - 1];
  }
  for (std::size_t i = n; i-- > 0;)
  {
    if (i + 1 < n)
      right_side[i] -= beside[i] * right_side[i + 1];
    right_side[i] /= diagonal[i];
  }
}

/// Finds where the exact gradient has no bound.
class Singularities
{
public:
  Singularities(const meshes::TriangleMesh& mesh, const std::vector<Edge>& edges)
  {
    for (const Edge& edge : edges)
      if (edge.after && is_singular(edge, *edge.after))
        places_.push_back(mesh.nodes[edge.to]);
    const auto [low, high] =
        std::ranges::minmax(mesh.nodes, {}, [](const Vec2& x) { return x.y(); });
    reach_ = kept_away_share * (high.y() - low.y());
  }
  [[nodiscard]] double reach() const { return reach_; }
  /// The nearest of those within reach.
  [[nodiscard]] std::optional<Vec2> beside(const Vec2& point) const
  {
    std::optional<Vec2> nearest;
    for (const Vec2& place : places_)
      if ((place - point).norm() < (nearest ? (*nearest - point).norm() : reach_))
        nearest = place;
    return nearest;
  }

private:
  Polyline places_;
  double reach_ = 0;
};

/// The gradient along the normal at a corner of the edge, where it is known.
std::optional<double> known_normal(const Edge* a, const Edge* b, const Edge& edge)
{
  if (!a || !b || !is_known(*a, *b))
    return std::nullopt;
  return -known_gradient(*a, *b).dot(edge.normal);
}

/// docs/theory.md eq. (2.22) along one side. Beside a singularity the mass is lumped: means over
/// half an edge on both sides of each node, which do not swing.
void find_gradients(const Side& side, const Solution& solution, const Singularities& singularities)
{
  const std::vector<double>& reaction = solution.reaction;
  const std::size_t n = side.size();
  std::vector<double> diagonal(n + 1, 0), beside(n, 0), right_side(n + 1, 0);
  for (std::size_t k = 0; k < n; ++k)
  {
    const Edge& edge = *side[k];
    const bool lumped = singularities.beside(solution.mesh.nodes[edge.from]) ||
                        singularities.beside(solution.mesh.nodes[edge.to]);
    const double w = edge.k_nn * edge.length;
    diagonal[k] += w / (lumped ? 2 : 3);
    diagonal[k + 1] += w / (lumped ? 2 : 3);
    beside[k] = lumped ? 0 : w / 6;
    right_side[k] += edge.k_nt * edge.slope * edge.length / 2;
    right_side[k + 1] += edge.k_nt * edge.slope * edge.length / 2 - reaction[edge.to];
  }
  const Edge &first = *side.front(), &last = *side.back();
  right_side.front() -= reaction[first.from];
  if (n > 1 && first.from == last.to) // all round: half of the reaction belongs to either end
  {
    right_side.front() += reaction[first.from] / 2;
    right_side.back() += reaction[first.from] / 2;
  }
  const auto give = [&](std::size_t k, double value)
  {
    diagonal[k] = 1;
    right_side[k] = value;
    const std::size_t b = k == 0 ? 0 : n - 1, other = k == 0 ? 1 : n - 1;
    right_side[other] -= beside[b] * value;
    beside[b] = 0;
  };
  if (const auto value = known_normal(first.before, &first, first))
    give(0, *value);
  if (const auto value = known_normal(&last, last.after, last))
    give(n, *value);
  solve_tridiagonal(diagonal, beside, right_side);
  for (std::size_t k = 0; k < n; ++k)
  {
    side[k]->at_from = right_side[k];
    side[k]->at_to = right_side[k + 1];
  }
}

/// Whether water leaves through the edge: from the reactions alone, which do not swing as the
/// gradients do beside a singularity.
bool lets_out(const Edge& edge, const std::vector<double>& reaction)
{
  if (edge.state != EdgeState::wet)
    return false;
  const auto density = [&](std::size_t node, const Edge* a, const Edge* b)
  {
    double length = 0;
    for (const Edge* e : {a, b})
      length += e && e->state == EdgeState::wet ? e->length / 2 : 0;
    return reaction[node] / length;
  };
  return density(edge.from, edge.before, &edge) + density(edge.to, &edge, edge.after) < 0;
}

/// @param[in] t  Position on the edge, 0 to 1.
ExitPoint exit_point(const Solution& solution, const Edge& edge, double t)
{
  const auto between = [t](const auto& from, const auto& to) { return (1 - t) * from + t * to; };
  ExitPoint point;
  point.at = between(solution.mesh.nodes[edge.from], solution.mesh.nodes[edge.to]);
  point.head = between(solution.head[edge.from], solution.head[edge.to]);
  point.normal = between(edge.at_from, edge.at_to);
  point.upward = edge.gradient(point.normal).y();
  point.flux = edge.flux(point.normal);
  point.faces_up = edge.normal.y() > std::sin(straight);
  point.soil = edge.soil;
  return point;
}

/// Where the segment a-b leaves the circle about the centre, one end being inside: 0 at a, 1 at b.
double crossing(const Vec2& a, const Vec2& b, const Vec2& centre, double radius)
{
  const Vec2 ab = b - a, ca = a - centre;
  const double half = ca.dot(ab) / ab.squaredNorm();
  const double rest = (ca.squaredNorm() - radius * radius) / ab.squaredNorm();
  const double root = std::sqrt(std::max(half * half - rest, 0.0));
  return std::clamp(rest < 0 ? root - half : -root - half, 0.0, 1.0);
}

/// @param[in] edges  One after the other.
Outlet outlet_of(const Solution& solution, const Side& edges, const Singularities& singularities)
{
  Outlet outlet{.stretch = edges.front()->stretch, .points = {}, .steepest = {}, .unbounded = {}};
  outlet.kept_away = singularities.reach();
  double distance = 0;
  const auto add = [&](const Edge& edge, double t, std::optional<Vec2> beside)
  {
    ExitPoint& point = outlet.points.emplace_back(exit_point(solution, edge, t));
    point.distance = distance + t * edge.length;
    point.beside_singularity = beside;
    if (beside && std::ranges::find(outlet.unbounded, *beside) == outlet.unbounded.end())
      outlet.unbounded.push_back(*beside);
  };
  for (const Edge* edge : edges)
  {
    const Vec2 &a = solution.mesh.nodes[edge->from], &b = solution.mesh.nodes[edge->to];
    const auto beside_a = singularities.beside(a), beside_b = singularities.beside(b);
    if (edge == edges.front() || turns(*edge->before, *edge))
      add(*edge, 0, beside_a);
    if (beside_a.has_value() != beside_b.has_value()) // from here on points count
      add(*edge, crossing(a, b, beside_a ? *beside_a : *beside_b, singularities.reach()), {});
    add(*edge, 1, beside_b);
    distance += edge->length;
    outlet.outflow += edge->length * (edge->flux(edge->at_from) + edge->flux(edge->at_to)) / 2;
  }
  for (std::size_t k = 0; k < outlet.points.size(); ++k)
    if (!outlet.points[k].beside_singularity &&
        (!outlet.steepest || outlet.points[k].normal > outlet.points[*outlet.steepest].normal))
      outlet.steepest = k;
  return outlet;
}
} // namespace

std::vector<Outlet> outlets(const Solution& solution, std::span<const Boundary> boundary,
                            std::span<const Conductivity> conductivity)
{
  if (!(solution.discharge > 0))
    return {};
  std::vector<Edge> edges = edges_of(solution, boundary, conductivity);
  const Singularities singularities(solution.mesh, edges);
  for (const Side& side : sides_of(edges))
    find_gradients(side, solution, singularities);

  const auto goes_on = [&](const Edge* a, const Edge* b)
  {
    return a && b && lets_out(*a, solution.reaction) && lets_out(*b, solution.reaction) &&
           a->stretch == b->stretch;
  };
  std::vector<Outlet> result;
  for (Edge& edge : edges)
  {
    if (!lets_out(edge, solution.reaction) || goes_on(edge.before, &edge))
      continue;
    Side run{&edge};
    while (goes_on(run.back(), run.back()->after) && run.back()->after != &edge)
      run.push_back(run.back()->after);
    Outlet outlet = outlet_of(solution, run, singularities);
    if (outlet.outflow > least_outflow * solution.discharge)
      result.push_back(std::move(outlet));
  }
  return result;
}
} // namespace berm::seepage
