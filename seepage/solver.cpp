// SPDX-License-Identifier: GPL-3.0-or-later
// The only translation unit that sees dolfinx and PETSc.
#include "seepage/flow_operator.h"

#include "core/error.h"
#include "seepage/dolfinx_versions.h"

#include "flow.h"

#include <dolfinx/fem/assembler.h>
#include <dolfinx/fem/petsc.h>
#include <dolfinx/la/petsc.h>
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
namespace versions = dolfinx_versions;

namespace
{
/// Above so many unknowns an iterative solver comes first: on one rank it needs less memory than
/// LU, and is slower; on several it gains more from each (docs/performance.md).
constexpr std::size_t largest_direct_solve = 1'500'000, largest_direct_solve_shared = 20'000;
/// Relative residual of the iterative solver: Newton needs no more.
constexpr double iterative_tolerance = 1e-6;
constexpr int iterative_steps = 100;
/// From so many unknowns on, factors of an earlier Newton step precondition the next, unless that
/// takes more than so many steps.
constexpr std::size_t smallest_reuse = 50'000;
constexpr int reuse_steps = 20;
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
    versions::log_errors_only();
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

MPI_Comm communicator(Mat A)
{
  MPI_Comm comm = MPI_COMM_NULL;
  check(PetscObjectGetComm(reinterpret_cast<PetscObject>(A), &comm), "PetscObjectGetComm");
  return comm;
}

int size_of(MPI_Comm comm)
{
  int size = 1;
  MPI_Comm_size(comm, &size);
  return size;
}

int rank_of(MPI_Comm comm)
{
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

/// The values that the ranks hold parts of, with zeros elsewhere: the sum, on every rank.
void add_up(std::vector<double>& values, MPI_Comm comm)
{
  if (size_of(comm) > 1)
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                  comm);
}

KspPtr make_solver(Mat A, KSPType type, int steps)
{
  KSP ksp = nullptr;
  check(KSPCreate(communicator(A), &ksp), "KSPCreate");
  KspPtr owner(ksp);
  check(KSPSetOperators(ksp, A, A), "KSPSetOperators");
  check(KSPSetType(ksp, type), "KSPSetType");
  check(KSPSetTolerances(ksp, iterative_tolerance, PETSC_DEFAULT, PETSC_DEFAULT, steps),
        "KSPSetTolerances");
  return owner;
}

PC preconditioner(KSP ksp, PCType type)
{
  PC pc = nullptr;
  check(KSPGetPC(ksp, &pc), "KSPGetPC");
  check(PCSetType(pc, type), "PCSetType");
  return pc;
}

KspPtr direct_solver(Mat A, bool reuse)
{
  KspPtr owner = make_solver(A, reuse ? KSPGMRES : KSPPREONLY, reuse_steps);
  PC pc = preconditioner(owner.get(), PCLU);
  if (size_of(communicator(A)) > 1) // PETSc's own factorises on one rank only
  {
    check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS), "PCFactorSetMatSolverType");
    return owner;
  }
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
  KspPtr owner = make_solver(A, KSPGMRES, iterative_steps);
  check(KSPGMRESSetRestart(owner.get(), iterative_steps), "KSPGMRESSetRestart");
  PC pc = preconditioner(owner.get(), PCHYPRE);
  check(PCHYPRESetType(pc, "boomeramg"), "PCHYPRESetType");
  // One level of aggressive coarsening: the cheapest hierarchy whose steps hardly grow in number
  // with the mesh.
  for (const auto& [option, value] : {std::pair{"agg_nl", "1"},
                                      {"coarsen_type", "HMIS"},
                                      {"interp_type", "ext+i"},
                                      {"P_max", "4"}})
    check(PetscOptionsSetValue(nullptr, fmt::format("-berm_pc_hypre_boomeramg_{}", option).c_str(),
                               value),
          "PetscOptionsSetValue");
  check(KSPSetOptionsPrefix(owner.get(), "berm_"), "KSPSetOptionsPrefix");
  check(KSPSetFromOptions(owner.get()), "KSPSetFromOptions");
  return owner;
}

bool solve(KSP ksp, const la::petsc::Vector& b, la::petsc::Vector& x)
{
  check(KSPSolve(ksp, b.vec(), x.vec()), "KSPSolve");
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetConvergedReason(ksp, &reason), "KSPGetConvergedReason");
  return reason > 0;
}

/// This rank's share of a count: a range.
std::array<std::size_t, 2> share(std::size_t count, MPI_Comm comm)
{
  const auto rank = static_cast<std::size_t>(rank_of(comm)),
             size = static_cast<std::size_t>(size_of(comm));
  return {count * rank / size, count * (rank + 1) / size};
}

std::shared_ptr<versions::Mesh> make_mesh(const meshes::TriangleMesh& input, MPI_Comm comm)
{
  std::vector<std::int64_t> cells;
  const auto [first_triangle, end_triangle] = share(input.triangles.size(), comm);
  cells.reserve(3 * (end_triangle - first_triangle));
  for (std::size_t t = first_triangle; t < end_triangle; ++t)
    cells.insert(cells.end(), input.triangles[t].begin(), input.triangles[t].end());
  std::vector<double> x;
  const auto [first_node, end_node] = share(input.nodes.size(), comm);
  x.reserve(2 * (end_node - first_node));
  for (std::size_t i = first_node; i < end_node; ++i)
    x.insert(x.end(), {input.nodes[i].x(), input.nodes[i].y()});
  return versions::make_mesh(comm, std::move(cells), x);
}
} // namespace

struct FlowOperator::Impl
{
  using Field = fem::Function<double>;
  using FieldPtr = std::shared_ptr<Field>;

  MPI_Comm comm = MPI_COMM_SELF;
  // Renumberings: degree of freedom of this rank, ghosts last -> node; cell of this rank ->
  // triangle.
  std::vector<std::size_t> node_of_dof;
  std::vector<std::size_t> triangle_of_cell;
  std::size_t owned = 0;     ///< degrees of freedom
  std::size_t triangles = 0; ///< of all ranks

  std::shared_ptr<versions::Mesh> mesh;
  FieldPtr p, w, eps, shift, k_min, k_sat, curve;
  std::unique_ptr<fem::Form<double>> residual, jacobian, flux;
  std::vector<double> flux_vector;

  std::unique_ptr<la::petsc::Matrix> A;
  std::unique_ptr<la::petsc::Vector> b, x;
  KspPtr direct, iterative;
  std::vector<double> dof_vector;
  std::vector<std::int8_t> fixed;

  /// A x = b of n unknowns; false if nothing solves it.
  bool solve(std::size_t n)
  {
    if (n > (size_of(comm) > 1 ? largest_direct_solve_shared : largest_direct_solve))
    {
      if (!iterative)
        iterative = iterative_solver(A->mat());
      if (seepage::solve(iterative.get(), *b, *x))
        return true;
    }
    const bool reuse = n >= smallest_reuse;
    if (!direct)
      direct = direct_solver(A->mat(), reuse);
    else if (reuse)
    {
      check(KSPSetReusePreconditioner(direct.get(), PETSC_TRUE), "KSPSetReusePreconditioner");
      if (seepage::solve(direct.get(), *b, *x))
        return true;
      check(KSPSetReusePreconditioner(direct.get(), PETSC_FALSE), "KSPSetReusePreconditioner");
    }
    return seepage::solve(direct.get(), *b, *x);
  }

  void set_pressure(std::span<const double> nodal)
  {
    const std::span<double> values = p->x()->mutable_array();
    for (std::size_t d = 0; d < node_of_dof.size(); ++d)
      values[d] = nodal[node_of_dof[d]];
  }
};

FlowOperator::FlowOperator(const meshes::TriangleMesh& mesh,
                           std::span<const ConductivityTensor> conductivity,
                           std::span<const double> weight, FlowOptions options)
{
  ensure_session();
  impl_ = std::make_unique<Impl>();
  Impl& s = *impl_;
  s.comm = options.distributed ? MPI_COMM_WORLD : MPI_COMM_SELF;
  s.mesh = make_mesh(mesh, s.comm);
  const auto V = versions::make_space(s.mesh, "p", 1),
             per_triangle = versions::make_space(s.mesh, "eps", 0);
  s.p = std::make_shared<Impl::Field>(V);
  s.w = std::make_shared<Impl::Field>(V);
  s.eps = std::make_shared<Impl::Field>(per_triangle);
  s.shift = std::make_shared<Impl::Field>(per_triangle);
  s.k_min = std::make_shared<Impl::Field>(per_triangle);
  s.k_sat = std::make_shared<Impl::Field>(versions::make_space(s.mesh, "k_sat", 0, 3));
  s.curve = std::make_shared<Impl::Field>(versions::make_space(s.mesh, "curve", 0, 4));

  // dolfinx renumbers cells, vertices and unknowns.
  const std::vector<std::int64_t>& node_of_vertex = s.mesh->geometry().input_global_indices();
  for (const std::int64_t triangle : versions::triangle_of_cell(*s.mesh))
    s.triangle_of_cell.push_back(static_cast<std::size_t>(triangle));
  const auto& index_map = *s.p->function_space()->dofmap()->index_map;
  s.owned = static_cast<std::size_t>(index_map.size_local());
  s.node_of_dof.resize(s.owned + static_cast<std::size_t>(index_map.num_ghosts()));
  for (std::size_t c = 0; c < s.triangle_of_cell.size(); ++c)
  {
    const auto cell = static_cast<std::int32_t>(c);
    const auto dofs = s.p->function_space()->dofmap()->cell_dofs(cell);
    for (std::size_t k = 0; k < 3; ++k)
      s.node_of_dof[static_cast<std::size_t>(dofs[k])] = static_cast<std::size_t>(
          node_of_vertex[static_cast<std::size_t>(versions::vertex(*s.mesh, cell, k))]);
  }

  const std::span<double> w = s.w->x()->mutable_array();
  for (std::size_t d = 0; d < s.node_of_dof.size(); ++d)
    w[d] = weight[s.node_of_dof[d]];
  const std::span<double> k_sat = s.k_sat->x()->mutable_array();
  for (std::size_t c = 0; c < s.triangle_of_cell.size(); ++c)
  {
    const ConductivityTensor& k = conductivity[s.triangle_of_cell[c]];
    std::ranges::copy(std::array{k.xx, k.xy, k.yy},
                      k_sat.begin() + static_cast<std::ptrdiff_t>(3 * c));
  }
  const versions::Fields fields{{"p", s.p},         {"w", s.w},         {"eps", s.eps},
                                {"shift", s.shift}, {"k_min", s.k_min}, {"k_sat", s.k_sat},
                                {"curve", s.curve}};
  const bool curves = options.curves;
  s.residual =
      versions::make_form(curves ? *form_flow_curve_residual : *form_flow_residual, {V}, fields);
  s.jacobian =
      versions::make_form(curves ? *form_flow_curve_jacobian : *form_flow_jacobian, {V, V}, fields);
  s.flux = versions::make_form(curves ? *form_flow_curve_flux : *form_flow_flux,
                               {versions::make_space(s.mesh, "t", 0, 2)}, fields);

  s.A = std::make_unique<la::petsc::Matrix>(fem::petsc::create_matrix(*s.jacobian), false);
  s.b = std::make_unique<la::petsc::Vector>(*V->dofmap()->index_map, 1);
  s.x = std::make_unique<la::petsc::Vector>(*V->dofmap()->index_map, 1);
  s.dof_vector.resize(s.node_of_dof.size());
  s.fixed.resize(s.node_of_dof.size());
  s.flux_vector.resize(2 * s.triangle_of_cell.size());
  s.triangles = mesh.triangles.size();
  set_relative_conductivity(std::vector<RelativeConductivity>(mesh.triangles.size()));
}

FlowOperator::~FlowOperator() = default;

void FlowOperator::set_relative_conductivity(std::span<const RelativeConductivity> laws)
{
  const std::span<double> eps = impl_->eps->x()->mutable_array(),
                          shift = impl_->shift->x()->mutable_array(),
                          k_min = impl_->k_min->x()->mutable_array(),
                          curve = impl_->curve->x()->mutable_array();
  for (std::size_t cell = 0; cell < impl_->triangle_of_cell.size(); ++cell)
  {
    const RelativeConductivity& law = laws[impl_->triangle_of_cell[cell]];
    const VanGenuchtenCurve& c = law.curve;
    eps[cell] = law.eps;
    shift[cell] = law.shift();
    k_min[cell] = law.k_min;
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
  residual.assign(p.size(), 0);
  for (std::size_t d = 0; d < s.node_of_dof.size(); ++d)
    residual[s.node_of_dof[d]] = s.dof_vector[d];
  add_up(residual, s.comm);
}

void FlowOperator::correction(std::span<const double> p, std::span<const std::uint8_t> fixed,
                              std::span<const double> right_side, std::vector<double>& correction)
{
  Impl& s = *impl_;
  s.set_pressure(p);
  {
    double* b = nullptr;
    check(VecGetArrayWrite(s.b->vec(), &b), "VecGetArrayWrite");
    for (std::size_t d = 0; d < s.node_of_dof.size(); ++d)
    {
      const std::size_t i = s.node_of_dof[d];
      s.fixed[d] = fixed[i] ? 1 : 0;
      if (d < s.owned)
        b[d] = fixed[i] ? 0 : right_side[i];
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
  for (std::size_t d = 0; d < s.owned; ++d)
    if (s.fixed[d])
    {
      const auto row = static_cast<PetscInt>(d);
      check(MatSetValueLocal(A, row, row, 1.0, INSERT_VALUES), "MatSetValueLocal");
    }
  check(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
  check(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");

  if (!s.solve(p.size()))
    throw NotConverged(
        fmt::format("seepage: the linear system of {} unknowns could not be solved", p.size()));

  correction.assign(p.size(), 0);
  const double* x = nullptr;
  check(VecGetArrayRead(s.x->vec(), &x), "VecGetArrayRead");
  for (std::size_t d = 0; d < s.owned; ++d)
    correction[s.node_of_dof[d]] = x[d];
  check(VecRestoreArrayRead(s.x->vec(), &x), "VecRestoreArrayRead");
  add_up(correction, s.comm);
}

std::vector<Vec2> FlowOperator::flux(std::span<const double> p)
{
  Impl& s = *impl_;
  s.set_pressure(p);
  std::ranges::fill(s.flux_vector, 0.0);
  fem::assemble_vector<double>(std::span(s.flux_vector), *s.flux);
  std::vector<double> components(2 * s.triangles, 0);
  for (std::size_t c = 0; c < s.triangle_of_cell.size(); ++c)
    for (std::size_t k = 0; k < 2; ++k)
      components[2 * s.triangle_of_cell[c] + k] = s.flux_vector[2 * c + k];
  add_up(components, s.comm);
  std::vector<Vec2> flux;
  flux.reserve(s.triangles);
  for (std::size_t t = 0; t < s.triangles; ++t)
    flux.emplace_back(components[2 * t], components[2 * t + 1]);
  return flux;
}
} // namespace berm::seepage
