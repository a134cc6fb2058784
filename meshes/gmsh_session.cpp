// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/gmsh_session.h"

#include <gmsh.h>
#include <omp.h>

#include <initializer_list>
#include <utility>

namespace berm::meshes
{
GmshSession::GmshSession() : threads_before_(omp_get_max_threads())
{
  gmsh::initialize(0, nullptr, false);
  for (const auto& [option, value] :
       std::initializer_list<std::pair<const char*, double>>{{"General.Terminal", 0},
                                                             {"General.NumThreads", 1},
                                                             {"Mesh.MeshSizeExtendFromBoundary", 0},
                                                             {"Mesh.MeshSizeFromPoints", 0},
                                                             {"Mesh.MeshSizeFromCurvature", 0},
                                                             {"Geometry.AutoCoherence", 0}})
    gmsh::option::setNumber(option, value);
}

GmshSession::~GmshSession()
{
  gmsh::finalize();
  omp_set_num_threads(threads_before_);
}
} // namespace berm::meshes
