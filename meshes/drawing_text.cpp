// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/drawing_text.h"

#include <fmt/format.h>

#include <sstream>

namespace berm::meshes
{
namespace
{
/// "LENGTH NAME COUNT x y x y ...": names may hold anything.
std::string one(const std::string& name, const Polyline& points)
{
  std::string text = fmt::format("{} {} {}", name.size(), name, points.size());
  for (const Vec2& p : points)
    text += fmt::format(" {} {}", p.x(), p.y()); // the shortest text that is the same number
  return text + '\n';
}

void read(std::istream& in, std::string& name, Polyline& points)
{
  std::size_t length = 0, count = 0;
  in >> length;
  in.get();
  name.resize(length);
  in.read(name.data(), static_cast<std::streamsize>(length));
  in >> count;
  points.resize(count);
  for (Vec2& p : points)
    for (double* x : {&p.x(), &p.y()})
    {
      std::string number; // streams do not read "nan"
      in >> number;
      *x = std::stod(number);
    }
}
} // namespace

std::string drawing_text(const GmshDrawing& drawing)
{
  std::string text = fmt::format("{} {}\n", drawing.regions.size(), drawing.curves.size());
  text += one("", drawing.outline);
  for (const DrawnRegion& region : drawing.regions)
    text += one(region.name, region.polygon);
  for (const DrawnCurve& curve : drawing.curves)
    text += one(curve.name, curve.line);
  return text;
}

GmshDrawing drawing_from(const std::string& text)
{
  std::istringstream in(text);
  std::size_t regions = 0, curves = 0;
  in >> regions >> curves;
  GmshDrawing drawing;
  drawing.regions.resize(regions);
  drawing.curves.resize(curves);
  std::string none;
  read(in, none, drawing.outline);
  for (DrawnRegion& region : drawing.regions)
    read(in, region.name, region.polygon);
  for (DrawnCurve& curve : drawing.curves)
    read(in, curve.name, curve.line);
  return drawing;
}
} // namespace berm::meshes
