// SPDX-License-Identifier: GPL-2.0-or-later
#include "sph/mechanism.h"

namespace berm::sph
{
std::optional<Mechanism> find_mechanism(const Particles&, const State&, const meshes::Section&)
{
  return std::nullopt;
}
} // namespace berm::sph
