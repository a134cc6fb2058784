// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/strategies.h"

#include "core/error.h"
#include "seepage/head_bounds.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace berm::seepage
{
namespace
{
TEST(RescaledPressure, KeepsTheRelativeConductivityOfSoilThatConductsMoreThanTheFloor)
{
  // exp(p / eps - 1) is the same before and after.
  for (const double p : {-0.1, -1.0, -2.0})
    EXPECT_DOUBLE_EQ(rescaled_pressure(p, 0.5, 0.05, 1e-5) / 0.05, p / 0.5);
}

TEST(RescaledPressure, LeavesWetSoilAlone)
{
  EXPECT_EQ(rescaled_pressure(0, 0.5, 0.05, 1e-5), 0);
  EXPECT_EQ(rescaled_pressure(3, 0.5, 0.05, 1e-5), 3);
}

TEST(RescaledPressure, KeepsDifferencesWhereTheFloorGoverns)
{
  const double dry = 0.5 * (1 + std::log(1e-5));
  EXPECT_NEAR(rescaled_pressure(dry - 3, 0.5, 0.05, 1e-5) -
                  rescaled_pressure(dry - 1, 0.5, 0.05, 1e-5),
              -2, 1e-14);
}

struct Notes : Observer
{
  std::vector<std::string> notes;
  void note(std::string_view text) override { notes.emplace_back(text); }
};

/// 8 m x 4 m on a structured mesh, 3 m of water on the left: q = 9/16.
struct Dam
{
  meshes::TriangleMesh mesh;
  NodeConditions conditions;
  std::vector<double> k;
  std::vector<RelativeConductivity> laws;
  FlowOperator flow;

  explicit Dam(double k_inside = 1)
      : mesh(tests::rectangle_mesh(section(), 32, 16)),
        conditions(node_conditions(mesh, boundary())), k(mesh.triangles.size(), 1),
        laws(mesh.triangles.size(), law()),
        flow(mesh, tensors(k_inside), face_weight(mesh, conditions.face_edges))
  {
  }

  /// 1 m/s, but in the triangles around (3, 1) m.
  [[nodiscard]] std::vector<ConductivityTensor> tensors(double k_inside) const
  {
    std::vector<ConductivityTensor> result(mesh.triangles.size(), {1, 0, 1});
    for (std::size_t t = 0; t < result.size(); ++t)
      for (const Index node : mesh.triangles[t])
        if ((mesh.nodes[static_cast<std::size_t>(node)] - Vec2(3, 1)).norm() < 0.3)
          result[t] = {k_inside, 0, k_inside};
    return result;
  }
  static RelativeConductivity law()
  {
    RelativeConductivity result;
    result.eps = 0.1;
    result.k_min = 1e-5;
    return result;
  }
  static std::vector<Boundary> boundary() { return boundary_conditions(section(), {}); }
  static meshes::Section section()
  {
    meshes::SectionInput input = tests::rectangle_input(8, 4);
    input.left_pool_level = 3;
    return meshes::build_section(input);
  }

  Field solve(const std::optional<CoarserField>& coarser, Observer& observer,
              bool last_resort = true)
  {
    return solve_by_strategies(flow, mesh, conditions, laws, {.height = 3, .conductivity = k},
                               coarser, last_resort, observer);
  }
};

CoarserField field(std::vector<double> p)
{
  const std::size_t n = p.size();
  return {.p = std::move(p), .eps = std::vector(n, 0.1), .largest_eps = 0.1};
}

TEST(Strategies, OnTheFirstMeshItIsTheFullSection)
{
  Dam d;
  Notes observer;
  const Field f = d.solve({}, observer);
  EXPECT_EQ(f.history.strategy, "full section");
  EXPECT_TRUE(observer.notes.empty());
  EXPECT_NEAR(f.inflow, 9 / 16., 0.02 * 9 / 16.); // elements of 0.25 m
}

TEST(Strategies, ASolutionIsItsOwnStart)
{
  Dam d;
  Notes observer;
  const Field first = d.solve({}, observer);
  const Field again = d.solve(field(first.p), observer);
  EXPECT_EQ(again.history.strategy, "coarser mesh");
  EXPECT_LE(again.history.newton_steps, 1);
  EXPECT_NEAR(again.inflow, first.inflow, 1e-7 * first.inflow); // the tolerance of the balance
}

TEST(Strategies, AUselessStartLeadsToTheSameAnswerAndIsTold)
{
  // Wet and dry by hundreds of metres from node to node.
  Dam d;
  Notes observer;
  const Field right = d.solve({}, observer);
  std::vector<double> p;
  for (std::size_t i = 0; i < d.mesh.nodes.size(); ++i)
    p.push_back(i % 2 == 0 ? 1e12 : -1e12);
  const Field f = d.solve(field(p), observer);
  EXPECT_NE(f.history.strategy, "coarser mesh");
  ASSERT_FALSE(observer.notes.empty());
  EXPECT_NE(observer.notes[0].find("no convergence from the coarser mesh"), std::string::npos)
      << observer.notes[0];
  EXPECT_NE(observer.notes[0].find("residual"), std::string::npos) << observer.notes[0];
  EXPECT_GT(f.history.newton_steps, right.history.newton_steps); // those that failed count
  EXPECT_NEAR(f.inflow, right.inflow, 1e-7 * right.inflow);
}

TEST(Strategies, WithALargerSmoothingLeftTheFullSectionIsNotTried)
{
  Dam d;
  Notes observer;
  const std::vector<double> useless(d.mesh.nodes.size(), NAN);
  EXPECT_THROW((void)d.solve(field(useless), observer, false), NotConverged);
  for (const std::string& note : observer.notes)
    EXPECT_EQ(note.find("full section"), std::string::npos) << note;
  EXPECT_EQ(d.solve(field(useless), observer).history.strategy, "full section");
}

TEST(Strategies, AFieldThatIsNotOneOfWaterIsNone)
{
  // Water that flows uphill in a few triangles: the equations have a solution, with heads above
  // that of the pool.
  Dam d(-0.75);
  Notes observer;
  try
  {
    const Field f = d.solve({}, observer);
    ADD_FAILURE() << "q = " << f.inflow << ", out of range by "
                  << head_excess(d.mesh, d.conditions, f.p);
  }
  catch (const NotConverged& refusal)
  {
    EXPECT_NE(std::string(refusal.what()).find("leave the range"), std::string::npos)
        << refusal.what();
  }
}

TEST(Strategies, WhateverTheStartAConvergedFieldIsTheSame)
{
  // A core of 1e-2 and 1e-3 from 4 to 8 m in a dam of 12 m x 12 m between 10 m and 2 m of water;
  // from pressure heads drawn within 1 m to 1000 m, at once and smoothed over 0.5 m.
  meshes::SectionInput input = tests::rectangle_input(12, 12);
  input.left_pool_level = 10;
  input.right_pool_level = 2;
  const meshes::Section section = meshes::build_section(input);
  const meshes::TriangleMesh mesh = tests::rectangle_mesh(section, 24, 24);
  const NodeConditions conditions = node_conditions(mesh, boundary_conditions(section, {}));
  RelativeConductivity law;
  law.eps = 0.1;
  for (const double core : {1e-2, 1e-3})
  {
    law.k_min = std::min(1e-5, 0.1 * core);
    std::vector<double> k;
    std::vector<ConductivityTensor> tensors;
    for (const auto& [a, b, c] : mesh.triangles)
    {
      const double x = (mesh.nodes[static_cast<std::size_t>(a)].x() +
                        mesh.nodes[static_cast<std::size_t>(b)].x() +
                        mesh.nodes[static_cast<std::size_t>(c)].x()) /
                       3;
      k.push_back(x > 4 && x < 8 ? core : 1);
      tensors.push_back({k.back(), 0, k.back()});
    }
    FlowOperator flow(mesh, tensors, face_weight(mesh, conditions.face_edges));
    const std::vector<RelativeConductivity> laws(mesh.triangles.size(), law);
    std::mt19937 random(1);
    std::vector<double> discharges;
    for (int trial = 0; trial < 12; ++trial)
    {
      std::uniform_real_distribution<double> head(-std::pow(10, trial % 4),
                                                  std::pow(10, trial % 4));
      Start start{.p = {}, .smoothing = trial % 2 == 0 ? 0.5 : 0.0};
      for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        start.p.push_back(head(random));
      SolveHistory history;
      Observer observer;
      try
      {
        const Field f = solve_field(flow, mesh, conditions, laws, {.height = 10, .conductivity = k},
                                    start, history, observer);
        EXPECT_LT(head_excess(mesh, conditions, f.p), 1e-7);
        discharges.push_back(f.inflow);
      }
      catch (const NotConverged&) // is an answer, too
      {
      }
    }
    ASSERT_GE(discharges.size(), 4);
    for (const double q : discharges)
      EXPECT_NEAR(q, discharges[0], 1e-6 * discharges[0]);
  }
}

TEST(Strategies, StopWhenAsked)
{
  struct Stop : Notes
  {
    [[nodiscard]] bool stop_requested() const override { return true; }
  } observer;
  Dam d;
  EXPECT_THROW(static_cast<void>(d.solve(field(std::vector(d.mesh.nodes.size(), 1.0)), observer)),
               NotConverged);
  EXPECT_TRUE(observer.notes.empty());
}
} // namespace
} // namespace berm::seepage
