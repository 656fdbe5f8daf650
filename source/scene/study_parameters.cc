// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/study_parameters.h"

#include "binder.h"
#include "checks.h"

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
             "Iterations after which the run fails.");
      binder("Direct limit",
             p.direct_limit,
             count_codec(),
             "automatic: largest number of unknowns for the direct solver.");
    }

    void
    bind(ReferenceParameters &p, Binder &binder)
    {
      binder("Type",
             p.type,
             word_codec<ReferenceParameters::Type>(),
             "The fine solution to compare with: none, one on a fine mesh that this program "
             "solves (once: it is kept in a cache), or the .vtu file of an earlier run.");
      binder("Mesh",
             p.route,
             word_codec<ReferenceParameters::MeshRoute>(),
             "fine mesh: refine the scene's first mesh by TetGen, cut the box into bricks, or "
             "read a file.");
      binder("Degree", p.degree, count_codec(), "fine mesh: polynomial degree, 1 or 2.");
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
    require(tolerance > 0. && tolerance < 1.,
            "Solver/Tolerance",
            "must be between 0 and 1, such as 1e-8; it is " + text_of(tolerance) + ".");
    require(max_iterations > 0, "Solver/Maximum iterations", "must be at least 1.");
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
    if (type == Type::run)
      {
        require(!file.empty(),
                "Reference/File",
                "Type = earlier run needs the name of a run's .vtu file.");
        check_file(file, "Reference/File", {".vtu"});
        return;
      }
    require(degree == 1 || degree == 2, "Reference/Degree", "must be 1 or 2.");
    require(volume_bound >= 0.,
            "Reference/Volume bound",
            "must be positive, or 0 for no bound; it is " + text_of(volume_bound) + ".");
    check_size(size, "Reference/Size");
    check_quality(radius_edge_ratio, dihedral_angle, "Reference");
    if (route == MeshRoute::refine)
      require(volume_bound > 0. || !size.empty(),
              "Reference/Mesh",
              "a reference that is refined from the first mesh needs Volume bound or Size: how "
              "fine shall it be?");
    if (route == MeshRoute::bricks)
      require(cells[0] > 0 && cells[1] > 0 && cells[2] > 0
                && 6. * cells[0] * cells[1] * cells[2] <= 1e8,
              "Reference/Cells",
              "there must be at least one brick in every direction, and not more than 100 "
              "million tetrahedra.");
    if (route == MeshRoute::file)
      {
        require(!file.empty(), "Reference/File", "Mesh = file needs the name of a volume mesh.");
        check_file(file, "Reference/File", {".msh", ".vtk", ".vtu", ".node", ".ele"});
      }
  }
} // namespace tetradapt::scene
