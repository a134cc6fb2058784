// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/trial_bytes.h"

namespace berm::sph
{
namespace
{
// Every member once, in one order for both directions.

template <class StateOrConst, class Visit>
void visit_state(StateOrConst& state, Visit&& visit)
{
  visit(state.ux);
  visit(state.uy);
  visit(state.vx);
  visit(state.vy);
  visit(state.stress);
  visit(state.plastic_strain);
  visit(state.x);
  visit(state.y);
  visit(state.density);
}

template <class TrialOrConst, class Visit>
void visit_members(TrialOrConst& trial,
                   Visit&& visit) requires std::is_same_v<std::remove_const_t<TrialOrConst>, Trial>
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
  visit_state(trial.state, visit);
}

template <class SettledOrConst, class Visit>
void visit_members(SettledOrConst& settled, Visit&& visit) requires
    std::is_same_v<std::remove_const_t<SettledOrConst>, Settled>
{
  visit(settled.settlement);
  visit(settled.steps);
  visit_state(settled.state, visit);
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

void write(ByteWriter& bytes, const Settled& settled)
{
  visit_members(settled, [&](const auto& member) { bytes.put(member); });
}

void read(ByteReader& bytes, Settled& settled)
{
  visit_members(settled, [&](auto& member) { bytes.get(member); });
}
} // namespace berm::sph
