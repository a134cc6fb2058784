// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/circle_fit.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <vector>

namespace berm::sph
{
std::optional<FittedCircle> fit_circle(const Polyline& line)
{
  const std::size_t n = line.size();
  if (n < 3)
    return std::nullopt;

  // Step 1: weights that sum to one, the centroid, and the mean square distance from it.
  std::vector<double> w(n, 0.0);
  double length = 0;
  for (std::size_t k = 1; k < n; ++k)
  {
    const double edge = (line[k] - line[k - 1]).norm();
    w[k - 1] += 0.5 * edge;
    w[k] += 0.5 * edge;
    length += edge;
  }
  if (!(length > 0))
    return std::nullopt;
  Vec2 centroid{0, 0};
  double mean_z = 0;
  for (std::size_t k = 0; k < n; ++k)
    centroid += (w[k] /= length) * line[k];
  for (std::size_t k = 0; k < n; ++k)
    mean_z += w[k] * (line[k] - centroid).squaredNorm();

  // Step 2: with the first coefficient scaled by 2 sqrt(mean z), Taubin's norm is that of the
  // vector.
  const double scale = 2 * std::sqrt(mean_z);
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < n; ++k)
  {
    const Vec2 p = line[k] - centroid;
    const Eigen::Vector3d row{(p.squaredNorm() - mean_z) / scale, p.x(), p.y()};
    moments += w[k] * row * row.transpose();
  }
  const Eigen::Vector3d least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors().col(0);
  const double A = least[0] / scale;
  if (std::abs(A) * length < 1e-6) // of a radius some 1e6 times the length
    return std::nullopt;

  // Step 3: A z + B x + C y - A mean_z = 0.
  const Vec2 centre = -Vec2{least[1], least[2]} / (2 * A);
  FittedCircle circle{.centre = centroid + centre,
                      .radius = std::sqrt(centre.squaredNorm() + mean_z)};
  for (std::size_t k = 0; k < n; ++k)
    circle.misfit += w[k] * std::pow((line[k] - circle.centre).norm() - circle.radius, 2);
  circle.misfit = std::sqrt(circle.misfit);
  return circle;
}
} // namespace berm::sph
