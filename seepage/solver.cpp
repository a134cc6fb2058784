// SPDX-License-Identifier: GPL-3.0-or-later
// The only translation unit that sees dolfinx and PETSc.
#include "seepage/flow_operator.h"

#include "core/error.h"

#include "flow.h"

#include <dolfinx/common/log.h>
#include <dolfinx/fem/Constant.h>
#include <dolfinx/fem/CoordinateElement.h>
#include <dolfinx/fem/Form.h>
#include <dolfinx/fem/Function.h>
#include <dolfinx/fem/FunctionSpace.h>
#include <dolfinx/fem/assembler.h>
#include <dolfinx/fem/petsc.h>
#include <dolfinx/fem/utils.h>
#include <dolfinx/la/petsc.h>
#include <dolfinx/mesh/Mesh.h>
#include <fmt/format.h>
#include <petscksp.h>

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>

namespace berm::seepage
{
namespace fem = dolfinx::fem;
namespace la = dolfinx::la;

namespace
{
/// Above this many unknowns an iterative solver is faster than LU.
constexpr std::size_t largest_direct_solve = 50'000;
/// Relative residual of the iterative solver: Newton needs no more.
constexpr double iterative_tolerance = 1e-6;
constexpr int iterative_steps = 300;
constexpr double smallest_pivot = 1e-200;

static_assert(std::is_same_v<PetscScalar, double>, "berm needs PETSc with real scalars");

void check(PetscErrorCode code, const char* what)
{
  if (code == 0)
    return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw NotConverged(fmt::format("PETSc: {} failed: {}", what, text ? text : "unknown error"));
}

/// MPI and PETSc from the first solve to the end of the process. Whoever started them ends them.
class Session
{
public:
  Session()
  {
    int mpi_runs = 0;
    MPI_Initialized(&mpi_runs);
    if (!mpi_runs)
    {
      // One process, which needs no launcher and no network.
      MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &mpi_runs);
      started_mpi_ = true;
    }
    PetscBool petsc_runs = PETSC_FALSE;
    PetscInitialized(&petsc_runs);
    if (!petsc_runs)
    {
      // Neither the user's option files nor PETSc's signal handler: the program is not PETSc's.
      std::string name = "berm", no_file = "-skip_petscrc", no_signals = "-no_signal_handler";
      std::array<char*, 4> arguments{name.data(), no_file.data(), no_signals.data(), nullptr};
      int count = 3;
      char** list = arguments.data();
      check(PetscInitialize(&count, &list, nullptr, nullptr), "PetscInitialize");
      started_petsc_ = true;
    }
    // Errors come back as codes, which `check` turns into exceptions.
    PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
    loguru::g_stderr_verbosity = loguru::Verbosity_ERROR;
  }
  ~Session()
  {
    int mpi_ended = 0;
    MPI_Finalized(&mpi_ended);
    if (mpi_ended)
      return;
    if (started_petsc_)
      PetscFinalize();
    if (started_mpi_)
      MPI_Finalize();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

private:
  bool started_mpi_ = false, started_petsc_ = false;
};

void ensure_session()
{
  static const Session session;
}

struct KspDeleter
{
  void operator()(KSP ksp) const { KSPDestroy(&ksp); }
};
using KspPtr = std::unique_ptr<std::remove_pointer_t<KSP>, KspDeleter>;

KspPtr direct_solver(Mat A)
{
  KSP ksp = nullptr;
  check(KSPCreate(PETSC_COMM_SELF, &ksp), "KSPCreate");
  KspPtr owner(ksp);
  check(KSPSetOperators(ksp, A, A), "KSPSetOperators");
  check(KSPSetType(ksp, KSPPREONLY), "KSPSetType");
  PC pc = nullptr;
  check(KSPGetPC(ksp, &pc), "KSPGetPC");
  check(PCSetType(pc, PCLU), "PCSetType");
#ifdef PETSC_HAVE_SUITESPARSE
  // A quarter faster than nested dissection on 9 000 and on 45 000 unknowns.
  check(PCFactorSetMatOrderingType(pc, MATORDERINGAMD), "PCFactorSetMatOrderingType");
#else
  check(PCFactorSetMatOrderingType(pc, MATORDERINGND), "PCFactorSetMatOrderingType");
#endif
  // Conductivities range over many decades: a small pivot is no zero one.
  check(PCFactorSetZeroPivot(pc, smallest_pivot), "PCFactorSetZeroPivot");
  check(PCFactorSetReuseOrdering(pc, PETSC_TRUE), "PCFactorSetReuseOrdering");
  check(PCFactorSetReuseFill(pc, PETSC_TRUE), "PCFactorSetReuseFill");
  return owner;
}

KspPtr iterative_solver(Mat A)
{
  KSP ksp = nullptr;
  check(KSPCreate(PETSC_COMM_SELF, &ksp), "KSPCreate");
  KspPtr owner(ksp);
  check(KSPSetOperators(ksp, A, A), "KSPSetOperators");
  check(KSPSetType(ksp, KSPGMRES), "KSPSetType");
  check(KSPGMRESSetRestart(ksp, 100), "KSPGMRESSetRestart");
  check(KSPSetTolerances(ksp, iterative_tolerance, PETSC_DEFAULT, PETSC_DEFAULT, iterative_steps),
        "KSPSetTolerances");
  PC pc = nullptr;
  check(KSPGetPC(ksp, &pc), "KSPGetPC");
  check(PCSetType(pc, PCHYPRE), "PCSetType(hypre)");
  check(PCHYPRESetType(pc, "boomeramg"), "PCHYPRESetType");
  return owner;
}

bool solve(KSP ksp, const la::petsc::Vector& b, la::petsc::Vector& x)
{
  check(KSPSolve(ksp, b.vec(), x.vec()), "KSPSolve");
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetConvergedReason(ksp, &reason), "KSPGetConvergedReason");
  return reason > 0;
}

std::shared_ptr<dolfinx::mesh::Mesh> make_mesh(const meshes::TriangleMesh& input)
{
  std::vector<std::int64_t> cells;
  cells.reserve(3 * input.triangles.size());
  for (const auto& triangle : input.triangles)
    cells.insert(cells.end(), triangle.begin(), triangle.end());
  std::vector<double> x;
  x.reserve(2 * input.nodes.size());
  for (const Vec2& node : input.nodes)
    x.insert(x.end(), {node.x(), node.y()});
  return std::make_shared<dolfinx::mesh::Mesh>(dolfinx::mesh::create_mesh(
      MPI_COMM_SELF, dolfinx::graph::regular_adjacency_list(std::move(cells), 3),
      fem::CoordinateElement(dolfinx::mesh::CellType::triangle, 1), x, {input.nodes.size(), 2},
      dolfinx::mesh::GhostMode::none));
}

using FieldPtr = std::shared_ptr<fem::Function<double>>;

FieldPtr make_field(const char* name, const std::shared_ptr<dolfinx::mesh::Mesh>& mesh)
{
  return std::make_shared<fem::Function<double>>(std::make_shared<fem::FunctionSpace>(
      fem::create_functionspace(functionspace_form_flow_curve_jacobian, name, mesh)));
}
} // namespace

struct FlowOperator::Impl
{
  // Renumberings: entry of the input -> degree of freedom (nodes), -> first of the cell's
  // (triangles).
  std::vector<std::size_t> dof_of_node;
  std::vector<std::size_t> cell_of_triangle;

  std::shared_ptr<dolfinx::mesh::Mesh> mesh;
  FieldPtr p, w, eps, shift, k_min, k_sat, curve;
  std::unique_ptr<fem::Form<double>> residual, jacobian, flux;
  std::vector<double> flux_vector;

  std::unique_ptr<la::petsc::Matrix> A;
  std::unique_ptr<la::petsc::Vector> b, x;
  KspPtr direct, iterative;
  std::vector<double> dof_vector;
  std::vector<std::int8_t> fixed;

  void set_pressure(std::span<const double> nodal)
  {
    const std::span<double> values = p->x()->mutable_array();
    for (std::size_t i = 0; i < nodal.size(); ++i)
      values[dof_of_node[i]] = nodal[i];
  }
};

FlowOperator::FlowOperator(const meshes::TriangleMesh& mesh,
                           std::span<const ConductivityTensor> conductivity,
                           std::span<const double> weight, bool curves)
{
  ensure_session();
  impl_ = std::make_unique<Impl>();
  Impl& s = *impl_;
  s.mesh = make_mesh(mesh);
  s.p = make_field("p", s.mesh);
  s.w = make_field("w", s.mesh);
  s.eps = make_field("eps", s.mesh);
  s.shift = make_field("shift", s.mesh);
  s.k_min = make_field("k_min", s.mesh);
  s.k_sat = make_field("k_sat", s.mesh);
  s.curve = make_field("curve", s.mesh);

  // dolfinx renumbers cells, vertices and unknowns.
  const std::vector<std::int64_t>& node_of_vertex = s.mesh->geometry().input_global_indices();
  const std::vector<std::int64_t>& triangle_of_cell = s.mesh->topology().original_cell_index;
  s.dof_of_node.resize(mesh.nodes.size());
  s.cell_of_triangle.resize(mesh.triangles.size());
  for (std::size_t c = 0; c < triangle_of_cell.size(); ++c)
  {
    s.cell_of_triangle[static_cast<std::size_t>(triangle_of_cell[c])] = c;
    const auto vertices = s.mesh->geometry().dofmap().links(static_cast<std::int32_t>(c));
    const auto dofs = s.p->function_space()->dofmap()->cell_dofs(static_cast<std::int32_t>(c));
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto vertex = static_cast<std::size_t>(vertices[k]);
      s.dof_of_node[static_cast<std::size_t>(node_of_vertex[vertex])] =
          static_cast<std::size_t>(dofs[k]);
    }
  }

  const std::span<double> w = s.w->x()->mutable_array();
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    w[s.dof_of_node[i]] = weight[i];
  const std::span<double> k_sat = s.k_sat->x()->mutable_array();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const std::size_t first = 3 * s.cell_of_triangle[t];
    k_sat[first] = conductivity[t].xx;
    k_sat[first + 1] = conductivity[t].xy;
    k_sat[first + 2] = conductivity[t].yy;
  }
  const std::map<std::string, std::shared_ptr<const fem::Function<double>>> fields{
      {"p", s.p},         {"w", s.w},         {"eps", s.eps},    {"shift", s.shift},
      {"k_min", s.k_min}, {"k_sat", s.k_sat}, {"curve", s.curve}};
  const std::map<std::string, std::shared_ptr<const fem::Constant<double>>> constants;
  const std::shared_ptr<const fem::FunctionSpace> V = s.p->function_space();
  const auto fluxes = std::make_shared<const fem::FunctionSpace>(
      fem::create_functionspace(functionspace_form_flow_flux, "t", s.mesh));
  s.residual = std::make_unique<fem::Form<double>>(fem::create_form<double>(
      curves ? *form_flow_curve_residual : *form_flow_residual, {V}, fields, constants, {}));
  s.jacobian = std::make_unique<fem::Form<double>>(fem::create_form<double>(
      curves ? *form_flow_curve_jacobian : *form_flow_jacobian, {V, V}, fields, constants, {}));
  s.flux = std::make_unique<fem::Form<double>>(fem::create_form<double>(
      curves ? *form_flow_curve_flux : *form_flow_flux, {fluxes}, fields, constants, {}));

  s.A = std::make_unique<la::petsc::Matrix>(fem::petsc::create_matrix(*s.jacobian), false);
  s.b = std::make_unique<la::petsc::Vector>(*V->dofmap()->index_map, 1);
  s.x = std::make_unique<la::petsc::Vector>(*V->dofmap()->index_map, 1);
  s.dof_vector.resize(mesh.nodes.size());
  s.fixed.resize(mesh.nodes.size());
  s.flux_vector.resize(2 * mesh.triangles.size());
  set_relative_conductivity(std::vector<RelativeConductivity>(mesh.triangles.size()));
}

FlowOperator::~FlowOperator() = default;

void FlowOperator::set_relative_conductivity(std::span<const RelativeConductivity> laws)
{
  const std::span<double> eps = impl_->eps->x()->mutable_array(),
                          shift = impl_->shift->x()->mutable_array(),
                          k_min = impl_->k_min->x()->mutable_array(),
                          curve = impl_->curve->x()->mutable_array();
  for (std::size_t t = 0; t < laws.size(); ++t)
  {
    const std::size_t cell = impl_->cell_of_triangle[t];
    const VanGenuchtenCurve& c = laws[t].curve;
    eps[cell] = laws[t].eps;
    shift[cell] = laws[t].shift();
    k_min[cell] = laws[t].k_min;
    std::ranges::copy(std::array{c.n, c.l, c.entry, c.scale},
                      curve.begin() + static_cast<std::ptrdiff_t>(4 * cell));
  }
}

void FlowOperator::residual(std::span<const double> p, std::vector<double>& residual)
{
  Impl& s = *impl_;
  s.set_pressure(p);
  std::ranges::fill(s.dof_vector, 0.0); // assembly adds
  fem::assemble_vector<double>(std::span(s.dof_vector), *s.residual);
  residual.resize(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    residual[i] = s.dof_vector[s.dof_of_node[i]];
}

void FlowOperator::correction(std::span<const double> p, std::span<const std::uint8_t> fixed,
                              std::span<const double> right_side, std::vector<double>& correction)
{
  Impl& s = *impl_;
  s.set_pressure(p);
  {
    double* b = nullptr;
    check(VecGetArrayWrite(s.b->vec(), &b), "VecGetArrayWrite");
    for (std::size_t i = 0; i < p.size(); ++i)
    {
      s.fixed[s.dof_of_node[i]] = fixed[i] ? 1 : 0;
      b[s.dof_of_node[i]] = fixed[i] ? 0 : right_side[i];
    }
    check(VecRestoreArrayWrite(s.b->vec(), &b), "VecRestoreArrayWrite");
  }

  // Rows and columns of fixed nodes are left out; a unit diagonal keeps their correction at zero.
  Mat A = s.A->mat();
  check(MatZeroEntries(A), "MatZeroEntries");
  fem::assemble_matrix<double>(la::petsc::Matrix::set_fn(A, ADD_VALUES), *s.jacobian,
                               std::span<const std::int8_t>(s.fixed),
                               std::span<const std::int8_t>(s.fixed));
  check(MatAssemblyBegin(A, MAT_FLUSH_ASSEMBLY), "MatAssemblyBegin");
  check(MatAssemblyEnd(A, MAT_FLUSH_ASSEMBLY), "MatAssemblyEnd");
  for (std::size_t i = 0; i < s.fixed.size(); ++i)
    if (s.fixed[i])
    {
      const auto row = static_cast<PetscInt>(i);
      check(MatSetValueLocal(A, row, row, 1.0, INSERT_VALUES), "MatSetValueLocal");
    }
  check(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
  check(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");

  bool solved = false;
  if (p.size() > largest_direct_solve)
  {
    if (!s.iterative)
      s.iterative = iterative_solver(A);
    solved = solve(s.iterative.get(), *s.b, *s.x);
  }
  if (!solved)
  {
    if (!s.direct)
      s.direct = direct_solver(A);
    solved = solve(s.direct.get(), *s.b, *s.x);
  }
  if (!solved)
    throw NotConverged(
        fmt::format("seepage: the linear system of {} unknowns could not be solved", p.size()));

  correction.resize(p.size());
  const double* x = nullptr;
  check(VecGetArrayRead(s.x->vec(), &x), "VecGetArrayRead");
  for (std::size_t i = 0; i < p.size(); ++i)
    correction[i] = x[s.dof_of_node[i]];
  check(VecRestoreArrayRead(s.x->vec(), &x), "VecRestoreArrayRead");
}

std::vector<Vec2> FlowOperator::flux(std::span<const double> p)
{
  Impl& s = *impl_;
  s.set_pressure(p);
  std::ranges::fill(s.flux_vector, 0.0);
  fem::assemble_vector<double>(std::span(s.flux_vector), *s.flux);
  std::vector<Vec2> flux(s.cell_of_triangle.size());
  for (std::size_t t = 0; t < flux.size(); ++t)
  {
    const std::size_t first = 2 * s.cell_of_triangle[t];
    flux[t] = {s.flux_vector[first], s.flux_vector[first + 1]};
  }
  return flux;
}
} // namespace berm::seepage
