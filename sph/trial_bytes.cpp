// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/trial_bytes.h"

namespace berm::sph
{
namespace
{
/// Every member of a trial once, in one order for both directions.
template <class TrialOrConst, class Visit>
void visit_members(TrialOrConst& trial, Visit&& visit)
{
  visit(trial.factor);
  visit(trial.outcome);
  visit(trial.reason);
  visit(trial.time);
  visit(trial.steps);
  visit(trial.velocity_measure);
  visit(trial.max_displacement);
  visit(trial.history);
  visit(trial.interrupted);
  visit(trial.seconds);
  visit(trial.state.ux);
  visit(trial.state.uy);
  visit(trial.state.vx);
  visit(trial.state.vy);
  visit(trial.state.stress);
  visit(trial.state.plastic_strain);
  visit(trial.state.x);
  visit(trial.state.y);
  visit(trial.state.density);
}
} // namespace

void write(ByteWriter& bytes, const Trial& trial)
{
  visit_members(trial, [&](const auto& member) { bytes.put(member); });
}

void read(ByteReader& bytes, Trial& trial)
{
  visit_members(trial, [&](auto& member) { bytes.get(member); });
}
} // namespace berm::sph
