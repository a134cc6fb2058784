// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "flow.h"

#include <basix/finite-element.h>
#include <dolfinx/common/log.h>
#include <dolfinx/common/version.h>
#include <dolfinx/fem/CoordinateElement.h>
#include <dolfinx/fem/Form.h>
#include <dolfinx/fem/Function.h>
#include <dolfinx/fem/FunctionSpace.h>
#include <dolfinx/fem/utils.h>
#include <dolfinx/mesh/Mesh.h>
#include <dolfinx/mesh/utils.h>

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// What DOLFINX 0.5 (Debian 12) and 0.9 (Debian 13) write differently. For solver.cpp alone.
namespace berm::seepage::dolfinx_versions
{
namespace fem = dolfinx::fem;

#if DOLFINX_VERSION_MINOR < 9
using Mesh = dolfinx::mesh::Mesh;
using FunctionSpace = fem::FunctionSpace;
using CoordinateElement = fem::CoordinateElement;

inline void log_errors_only()
{
  loguru::g_stderr_verbosity = loguru::Verbosity_ERROR;
}
#else
using Mesh = dolfinx::mesh::Mesh<double>;
using FunctionSpace = fem::FunctionSpace<double>;
using CoordinateElement = fem::CoordinateElement<double>;

inline void log_errors_only()
{
  spdlog::set_level(spdlog::level::err);
}
#endif

using Fields = std::map<std::string, std::shared_ptr<const fem::Function<double>>>;

/// @brief Triangles of this rank's share of the cells and nodes.
/// @param[in] cells  Nodes of each triangle, of all ranks, shape (3 m).
/// @param[in] x      Coordinates of the nodes [m], shape (2 n).
inline std::shared_ptr<Mesh> make_mesh(MPI_Comm comm, std::vector<std::int64_t> cells,
                                       const std::vector<double>& x)
{
#if DOLFINX_VERSION_MINOR < 9
  const auto triangles = dolfinx::graph::regular_adjacency_list(std::move(cells), 3);
#else
  const std::span<const std::int64_t> triangles(cells);
#endif
  return std::make_shared<Mesh>(dolfinx::mesh::create_mesh(
      comm, triangles, CoordinateElement(dolfinx::mesh::CellType::triangle, 1), x,
      {x.size() / 2, 2}, dolfinx::mesh::GhostMode::none));
}

/// Of each cell of this rank, the triangle that it was made from.
inline const std::vector<std::int64_t>& triangle_of_cell(const Mesh& mesh)
{
#if DOLFINX_VERSION_MINOR < 9
  return mesh.topology().original_cell_index;
#else
  return mesh.topology()->original_cell_index.at(0);
#endif
}

/// The k-th vertex of a cell.
inline std::int32_t vertex(const Mesh& mesh, std::int32_t cell, std::size_t k)
{
#if DOLFINX_VERSION_MINOR < 9
  return mesh.geometry().dofmap().links(cell)[k];
#else
  return mesh.geometry().dofmap()(cell, k);
#endif
}

/// @brief Lagrange elements as those of forms/flow.py.
/// DOLFINX 0.5, where its checks are on, takes for a form the spaces of the generated code alone.
/// @param[in] name        Of a coefficient there, or "t".
/// @param[in] degree      1: continuous, 0: constant in each triangle.
/// @param[in] components  1 or more.
inline std::shared_ptr<const FunctionSpace> make_space(const std::shared_ptr<Mesh>& mesh,
                                                       [[maybe_unused]] const char* name,
                                                       [[maybe_unused]] int degree,
                                                       [[maybe_unused]] int components = 1)
{
#if DOLFINX_VERSION_MINOR < 9
  const bool of_the_flux = std::string(name) == "t";
  return std::make_shared<const FunctionSpace>(fem::create_functionspace(
      of_the_flux ? functionspace_form_flow_flux : functionspace_form_flow_curve_jacobian, name,
      mesh));
#else
  const auto element =
      basix::create_element<double>(basix::element::family::P, basix::cell::type::triangle, degree,
                                    basix::element::lagrange_variant::gll_warped,
                                    basix::element::dpc_variant::unset, degree == 0);
  std::vector<std::size_t> shape;
  if (components > 1)
    shape.push_back(static_cast<std::size_t>(components));
  return std::make_shared<const FunctionSpace>(fem::create_functionspace(mesh, element, shape));
#endif
}

/// A form of the generated code, on its spaces and fields, over the whole mesh.
inline std::unique_ptr<fem::Form<double>>
make_form(const ufcx_form& form, const std::vector<std::shared_ptr<const FunctionSpace>>& spaces,
          const Fields& fields)
{
#if DOLFINX_VERSION_MINOR < 9
  return std::make_unique<fem::Form<double>>(
      fem::create_form<double>(form, spaces, fields, {}, {}));
#else
  return std::make_unique<fem::Form<double>>(
      fem::create_form<double>(form, spaces, fields, {}, {}, {}));
#endif
}
} // namespace berm::seepage::dolfinx_versions
