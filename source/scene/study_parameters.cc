// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/study_parameters.h"

#include "binder.h"
#include "require.h"

namespace tetradapt::scene
{
  namespace
  {
    void
    bind(SolverParameters &p, Binder &binder)
    {
      binder("Type",
             p.type,
             word_codec<SolverParameters::Type>(),
             "Linear solver: conjugate gradients with algebraic multigrid, a direct solver, or "
             "direct for small systems only.");
      binder("Tolerance",
             p.tolerance,
             number_codec(),
             "Residual at which the iteration ends, relative to the load.");
      binder("Maximum iterations",
             p.max_iterations,
             count_codec(),
             "Iterations in all after which the run fails (automatic: up to 150 000 unknowns the "
             "direct solver takes over).");
      binder("Direct limit",
             p.direct_limit,
             count_codec(),
             "automatic: largest number of unknowns for the direct solver from the start.");
      binder("Multigrid",
             p.multigrid,
             word_codec<SolverParameters::Multigrid>(),
             "What conjugate gradients solve the coarse problem of linear elements with: the "
             "program's own smoothed aggregation, or that of Trilinos (ML), which is slower and "
             "works in double precision.");
      binder("Stopping",
             p.stopping,
             word_codec<SolverParameters::Stopping>(),
             "When conjugate gradients stop: when the residual reaches Tolerance, or when their "
             "own error in the energy norm, as they estimate it, is small compared with the error "
             "of the mesh, predicted from the previous cycle.");
      binder("Solver error fraction",
             p.solver_error_fraction,
             number_codec(),
             "discretisation: how small, as a fraction of the error of the mesh.");
    }

    void
    bind(ReferenceParameters &p, Binder &binder)
    {
      binder("Type",
             p.type,
             word_codec<ReferenceParameters::Type>(),
             "The fine solution to compare with: none, one on a fine mesh that this program "
             "solves (once: it is kept in a cache), one on hexahedra refined where its own error "
             "is (for bodies made of axis-parallel boxes), or the .vtu file of an earlier run.");
      binder("Mesh",
             p.route,
             word_codec<ReferenceParameters::MeshRoute>(),
             "fine mesh: refine the scene's first mesh by TetGen, cut the box into bricks, or "
             "read a file.");
      binder("Degree",
             p.degree,
             count_codec(),
             "fine mesh: polynomial degree, 1 or 2. hexahedra: 2 or 3.");
      binder("Tolerance",
             p.tolerance,
             number_codec(),
             "hexahedra: refined until the estimate of its own relative energy error is below "
             "this; 0: a tenth of Adaptivity/Tolerance, or 0.001 if there is none.");
      binder("Maximum unknowns",
             p.max_dofs,
             long_count_codec(),
             "hexahedra: no system larger than that.");
      binder("Cells", p.cells, brick_codec(), "bricks: how many along x, y and z.");
      binder("Volume bound",
             p.volume_bound,
             number_codec(),
             "refine: largest volume of a tetrahedron; 0: no bound.");
      binder("Size",
             p.size,
             text_codec("an expression in x, y, z, or nothing"),
             "refine: wanted edge length, an expression in x, y, z; empty: none. Make it small "
             "at re-entrant edges and where a support ends.");
      binder("Radius-edge ratio",
             p.radius_edge_ratio,
             number_codec(),
             "refine: as TetGen/Radius-edge ratio.");
      binder("Minimum dihedral angle",
             p.dihedral_angle,
             number_codec(),
             "refine: as TetGen/Minimum dihedral angle.");
      binder("File",
             p.file,
             text_codec("the name of a file"),
             "file: a volume mesh. earlier run: a cycle's .vtu file. Relative names count from "
             "the folder of the file that sets them.");
      binder("Cache",
             p.cache,
             yes_no_codec(),
             "fine mesh: keep the solution on disk and take it from there in later runs.");
      binder("Cache directory",
             p.cache_directory,
             text_codec("the name of a folder"),
             "Where it is kept; empty: output/cache below the working directory.");
    }

    void
    check_hexahedra(const ReferenceParameters &p, Mistakes &mistakes)
    {
      mistakes.require(p.degree == 2 || p.degree == 3,
                       "Reference/Degree",
                       "must be 2 or 3 for hexahedra.");
      mistakes.require(p.tolerance >= 0. && p.tolerance < 1.,
                       "Reference/Tolerance",
                       "is a relative error: it must be positive and smaller than 1, or 0; it is "
                         + text_of(p.tolerance) + ".");
      mistakes.require(p.max_dofs >= 1000, "Reference/Maximum unknowns", "must be at least 1000.");
    }

    void
    check_fine_mesh(const ReferenceParameters &p, Mistakes &mistakes)
    {
      mistakes.require(p.degree == 1 || p.degree == 2, "Reference/Degree", "must be 1 or 2.");
      mistakes.require(p.volume_bound >= 0.,
                       "Reference/Volume bound",
                       "must be positive, or 0 for no bound; it is " + text_of(p.volume_bound)
                         + ".");
      mistakes.attempt([&]() { check_size(p.size, "Reference/Size"); });
      mistakes.attempt(
        [&]() { check_quality(p.radius_edge_ratio, p.dihedral_angle, "Reference"); });
      if (p.route == ReferenceParameters::MeshRoute::refine)
        mistakes.require(p.volume_bound > 0. || !p.size.empty(),
                         "Reference/Mesh",
                         "a reference that is refined from the first mesh needs Volume bound or "
                         "Size, which say how fine it is.");
      if (p.route == ReferenceParameters::MeshRoute::bricks)
        mistakes.require(
          p.cells[0] > 0 && p.cells[1] > 0 && p.cells[2] > 0
            && 6. * p.cells[0] * p.cells[1] * p.cells[2] <= 1e8,
          "Reference/Cells",
          "there must be at least one brick in every direction, and not more than 100 "
          "million tetrahedra.");
      if (p.route == ReferenceParameters::MeshRoute::file)
        {
          mistakes.attempt([&]() {
            require(!p.file.empty(),
                    "Reference/File",
                    "Mesh = file needs the name of a volume mesh.");
            check_file(p.file, "Reference/File", {".msh", ".vtk", ".vtu", ".node", ".ele"});
          });
        }
    }
  } // namespace

  void
  SolverParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  SolverParameters::parse(dealii::ParameterHandler &prm)
  {
    parse_bound(*this, prm, bind);
  }

  void
  SolverParameters::check() const
  {
    Mistakes mistakes;
    mistakes.require(tolerance > 0. && tolerance < 1.,
                     "Solver/Tolerance",
                     "must be between 0 and 1, such as 1e-8; it is " + text_of(tolerance) + ".");
    mistakes.require(max_iterations > 0, "Solver/Maximum iterations", "must be at least 1.");
    mistakes.require(solver_error_fraction > 0. && solver_error_fraction < 1.,
                     "Solver/Solver error fraction",
                     "must be between 0 and 1, such as 0.1; it is " + text_of(solver_error_fraction)
                       + ".");
    mistakes.throw_together();
  }

  void
  ReferenceParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  ReferenceParameters::parse(dealii::ParameterHandler &prm)
  {
    parse_bound(*this, prm, bind);
  }

  void
  ReferenceParameters::check() const
  {
    if (type == Type::none)
      return;
    Mistakes mistakes;
    if (type == Type::run)
      mistakes.attempt([&]() {
        require(!file.empty(),
                "Reference/File",
                "Type = earlier run needs the name of a run's .vtu file.");
        check_file(file, "Reference/File", {".vtu"});
      });
    else if (type == Type::hexahedra)
      check_hexahedra(*this, mistakes);
    else
      check_fine_mesh(*this, mistakes);
    mistakes.throw_together();
  }
} // namespace tetradapt::scene
