// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/strategies.h"

#include "core/error.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
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

  Dam()
      : mesh(tests::rectangle_mesh(section(), 32, 16)),
        conditions(node_conditions(mesh, boundary())), k(mesh.triangles.size(), 1),
        laws(mesh.triangles.size(), law()),
        flow(mesh, std::vector(mesh.triangles.size(), ConductivityTensor{1, 0, 1}),
             face_weight(mesh, conditions.face_edges))
  {
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
