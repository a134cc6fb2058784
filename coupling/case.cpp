// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/case.h"

namespace berm::coupling
{
const char* to_string(PorePressureKind kind)
{
  switch (kind)
  {
  case PorePressureKind::none:
    return "none";
  case PorePressureKind::hydrostatic:
    return "hydrostatic";
  case PorePressureKind::seepage:
    break;
  }
  return "seepage";
}
} // namespace berm::coupling
