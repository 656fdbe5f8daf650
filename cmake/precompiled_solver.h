// SPDX-License-Identifier: AGPL-3.0-or-later
// What most files of the rooms mechanics and solve include. It costs 11 s once
// and saves 3 s a file; with DoFHandler, FEValues and Trilinos it would cost 40 s
// and save 4 s. A file still includes what it uses: it must compile without this
// header (TETRADAPT_PCH=OFF).
#ifndef tetradapt_precompiled_solver_h
#define tetradapt_precompiled_solver_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <deal.II/lac/la_parallel_vector.h>

#endif
