// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_tetgen_process_h
#define tetradapt_mesh_tetgen_process_h

#include "tetradapt/mesh/tetgen_protocol.h"

#include <string>

namespace tetradapt::mesh
{
  /** What a call of TetGen may take. */
  struct TetgenLimits
  {
    double time   = 600.;  ///< seconds of wall time
    double memory = 8192.; ///< MiB of address space
  };

  /**
   * Path of the program `tetradapt-tetgen`, in which TetGen runs: the value of the
   * environment variable TETRADAPT_TETGEN_WORKER if it is set, else the file of
   * that name next to the running program, else the one of the build tree.
   *
   * @throws NumericalError saying where it was looked for if it is in none of them.
   */
  std::string
  find_tetgen_worker();

  /**
   * Runs TetGen once in a process of its own and returns its mesh. The request
   * is passed on as it is: what can be said against it has to be said before.
   *
   * The process is made by posix_spawn, so this is safe within MPI programs; it
   * inherits no file of the caller and dies with it. Nothing is left behind
   * when an exception is thrown.
   *
   * @param what names the mesh in messages, for example "the box".
   * @throws NumericalError if TetGen crashes, gives up, exceeds a limit or
   *         cannot be started. The message ends with TetGen's last words.
   */
  TetgenReply
  run_tetgen(const TetgenRequest &request, const TetgenLimits &limits, const std::string &what);
} // namespace tetradapt::mesh

#endif
