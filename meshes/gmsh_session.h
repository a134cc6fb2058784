// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace berm::meshes
{
/// gmsh between its start and its end, silent and serial. It sets the number of OpenMP's threads
/// for the whole process; at its end that is as it was. Internal to meshes/; one at a time.
class GmshSession
{
public:
  GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
  ~GmshSession();

private:
  int threads_before_;
};
} // namespace berm::meshes
