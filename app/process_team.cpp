// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/process_team.h"

#include "core/error.h"

#include <cstdlib>
#ifdef BERM_WITH_SEEPAGE
#include <mpi.h>
#include <numeric>
#endif

namespace berm::app
{
namespace
{
/// As the launchers of Open MPI and of MPICH tell; 1 without a launcher.
int launched()
{
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* value = std::getenv(name))
      return std::atoi(value);
  return 1;
}

#ifdef BERM_WITH_SEEPAGE
class MpiTeam final : public Team
{
public:
  MpiTeam()
  {
    int given = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  }
  ~MpiTeam() override { MPI_Finalize(); }

  [[nodiscard]] int size() const override { return size_; }
  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] std::vector<std::string> gather(std::string mine) override
  {
    // A million particles' state is 0.1 GB: far below what an int counts.
    const int length = static_cast<int>(mine.size());
    std::vector<int> lengths(static_cast<std::size_t>(size_));
    MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, MPI_COMM_WORLD);
    std::vector<int> begin(lengths.size());
    std::exclusive_scan(lengths.begin(), lengths.end(), begin.begin(), 0);
    std::string all(static_cast<std::size_t>(begin.back() + lengths.back()), '\0');
    MPI_Allgatherv(mine.data(), length, MPI_CHAR, all.data(), lengths.data(), begin.data(),
                   MPI_CHAR, MPI_COMM_WORLD);
    std::vector<std::string> texts;
    for (std::size_t rank = 0; rank < lengths.size(); ++rank)
      texts.push_back(all.substr(static_cast<std::size_t>(begin[rank]),
                                 static_cast<std::size_t>(lengths[rank])));
    return texts;
  }

private:
  int size_ = 1, rank_ = 0;
};
#endif
} // namespace

Team& process_team()
{
  if (launched() > 1)
  {
#ifdef BERM_WITH_SEEPAGE
    static MpiTeam team; // before PETSc starts, so that it ends after it
    return team;
#else
    throw InputError({{.key = "mpirun",
                       .value = {},
                       .problem = "this berm was built without MPI",
                       .allowed = "one process",
                       .hint = "threads need no mpirun; or build with BERM_WITH_SEEPAGE"}});
#endif
  }
  static Team alone;
  return alone;
}

void end_team([[maybe_unused]] int code)
{
#ifdef BERM_WITH_SEEPAGE
  if (launched() > 1)
    MPI_Abort(MPI_COMM_WORLD, code);
#endif
}
} // namespace berm::app
