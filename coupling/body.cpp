// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/body.h"

#include "core/error.h"
#ifdef BERM_WITH_SEEPAGE
#include "meshes/mesher.h"
#endif
#include "sph/fill.h"
#include "sph/packing_check.h"
#include "sph/seeds.h"
#include "sph/trial_bytes.h"

#include <fmt/core.h>

#include <utility>

namespace berm::coupling
{
namespace
{
/// The mesh is one of its own, as fine as the particles.
sph::Particles fill(const meshes::Section& section, const SphSettings& settings)
{
  if (settings.packing != "mesh")
    return sph::fill(section, settings.spacing, settings.packing);
#ifdef BERM_WITH_SEEPAGE
  meshes::Section whole = section;
  whole.inner_lines.clear(); // walls and drains of no thickness: soil on either side
  const meshes::TriangleMesh mesh = meshes::triangulate(whole, sph::mesh_size(settings.spacing));
  return sph::fill_from_seeds(section, sph::mesh_seeds(mesh), settings.spacing, "mesh");
#else
  throw InputError({{.key = "sph.packing",
                     .value = "mesh",
                     .problem = "this berm was built without its mesher",
                     .allowed = "auto, columns, lattice, hexagonal",
                     .hint = "build with BERM_WITH_SEEPAGE, or leave sph.packing out"}});
#endif
}
} // namespace

std::vector<sph::Soil> with_held(const std::vector<sph::Soil>& soils)
{
  std::vector<sph::Soil> twice = soils;
  twice.insert(twice.end(), soils.begin(), soils.end());
  return twice;
}

Body make_body(const Scene& scene, double spacing)
{
  SphSettings settings = scene.input.sph;
  settings.spacing = spacing;
  Body body;
  sph::Particles& particles = body.particles = fill(scene.section, settings);
  body.pore_pressure = scene.p_w(particles.x, particles.y);
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const sph::Soil& soil = scene.soils[static_cast<std::size_t>(particles.soil[i])];
    particles.density[i] = body.pore_pressure[i] > 0 ? soil.saturated_density : soil.density;
  }
  const std::vector<sph::Soil> soils = with_held(scene.soils);
  body.discretisation = sph::discretise(particles, soils, body.pore_pressure, scene.section);
  sph::require_sound_packing(sph::measure_packing(particles, body.discretisation, scene.section),
                             particles);
  if (settings.formulation == "paper")
    body.moving = sph::moving_body(particles, soils, body.pore_pressure, scene.section,
                                   sph::paper_settings());
  return body;
}

void settle(Body& body, const Scene& scene, Observer& observer)
{
  const std::string name = fmt::format("settled_{:a}", body.particles.spacing);
  if (const std::optional<std::string> kept = scene.work.kept(name))
  {
    body.settled = sph::from_bytes<sph::Settled>(*kept);
    return;
  }
  // The paper's soil is elastoplastic from the start; elastic settling also serves below F = 1.
  std::vector<sph::Cone> cones;
  if (body.moving)
    cones = cones_in_region(scene.soils, 1, scene.input.sph.cone);
  body.settled = sph::settle(body.model(), observer, cones);
  if (scene.team.rank() == 0)
    scene.work.keep(name, sph::to_bytes(body.settled));
}

std::vector<Body> coarser_bodies(const Scene& scene, Observer& observer)
{
  constexpr std::size_t fewest = 100; // particles: a slope ten high and ten long
  std::vector<Body> bodies;
  for (const double ratio : {2, 4})
    try
    {
      Body body = make_body(scene, ratio * scene.input.sph.spacing);
      if (body.particles.size() < fewest)
        break;
      settle(body, scene, observer);
      bodies.push_back(std::move(body));
    }
    catch (const InputError&) // its packing is refused
    {
      break;
    }
    catch (const NotConverged&) // too few to settle, or stopped
    {
      break;
    }
  return bodies;
}
} // namespace berm::coupling
