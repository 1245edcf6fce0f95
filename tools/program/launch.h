#pragma once
// What a launcher of MPI (mpirun, srun) has to do with this process, and the crew that its ranks are.

#include <folk/analysis/crew/crew.h>

#include <cstddef>
#include <exception>
#include <string>

namespace folk::tools {

/// What the environment says of the launcher that started this process.
struct Launch {
  std::size_t rank = 0;
  std::size_t ranks = 1;
  std::size_t rank_here = 0;  ///< among the ranks on this machine
  std::size_t ranks_here = 1;
};

/// Open MPI's variables, or those of PMI and PMIx with Slurm's; one rank where there are none, where a batch script of
/// Slurm runs a program without srun, and where the environment's FOLK_MPI is "off".
Launch launch_of_environment();

/// From now on this program is one of several ranks, if a launcher started several: only rank 0 speaks and writes.
void share_work();

/// False on ranks other than 0 of a program that shares its work.
bool speaks();

/// How many ranks of this program there are on this machine.
std::size_t ranks_here();

/// Joins the ranks, if there are several: loads the component of MPI. Throws EnvironmentError where it is not there or
/// does not find the others, UsageError where they have another command.
void join_ranks(const std::string& command);

/// Whoever shares the work: the ranks that have joined, or this process alone.
Crew& crew();

/// The end of the program: the ranks part. `failure`: what ended it. Returns the exit code for this process, `code` or
/// for ranks other than 0, of which rank 0 speaks, 0.
int leave_ranks(int code, const std::exception_ptr& failure);

}  // namespace folk::tools
