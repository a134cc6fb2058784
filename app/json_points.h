// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/result_json.h"
#include "core/tensor.h"

/// How points are written: [x, y].
namespace berm::app
{
[[nodiscard]] inline Json point(const Vec2& p)
{
  return Json::array({p.x(), p.y()});
}

[[nodiscard]] inline Json points(const Polyline& line)
{
  Json list = Json::array();
  for (const Vec2& p : line)
    list.push_back(point(p));
  return list;
}
} // namespace berm::app
