// SPDX-License-Identifier: AGPL-3.0-or-later
// What most files of the rooms from fem on include. It costs 11 s once and saves
// 2 s a file that works with vectors, of 4; others lose .2 s. With DoFHandler,
// FEValues and Trilinos it would cost 40 s and save 1 s more. A file still includes what it uses:
// it must compile without this header (TETRADAPT_PCH=OFF).
#ifndef tetradapt_precompiled_solver_h
#define tetradapt_precompiled_solver_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <deal.II/lac/la_parallel_vector.h>

#endif
