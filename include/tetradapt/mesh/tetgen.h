// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_tetgen_h
#define tetradapt_mesh_tetgen_h

#include "tetradapt/core/log.h"
#include "tetradapt/mesh/plc.h"
#include "tetradapt/mesh/sizing.h"
#include "tetradapt/scene/mesh_parameters.h"

namespace tetradapt::mesh
{
  /** What a call of TetGen did, and what of the wishes it left unmet. */
  struct TetgenReport
  {
    bool          called = false; ///< false: the mesh met every wish already
    std::string   switches;       ///< as given to TetGen
    unsigned long new_points = 0;
    /** The cap on new points (-S) stopped the refinement before its end. */
    bool cap_reached = false;
    /** Cells larger than Sizing::max_volume, for example because the boundary had
     * to be kept. */
    unsigned long oversized_cells = 0;
    double        volume_drift    = 0.; ///< relative change of the whole volume
    double        seconds         = 0.; ///< wall time, checks included
  };

  /**
   * Makes and refines tetrahedral meshes with TetGen 1.5 (H. Si, ACM TOMS 41(2),
   * 2015), which runs in a process of its own with limits on time and memory:
   * see tetgen_process.h. Not collective: call it on one MPI rank. The same
   * input gives the same mesh.
   *
   * How far sizes are met, measured on a cube: with Sizing::node_sizes the mean
   * of a cell's equivalent edge (6 sqrt(2) V)^(1/3) is within a few per cent of
   * what was asked for (TetGen itself overshoots by 1.21 at every quality bound,
   * which is taken out here). Volume bounds are passed as they are given and are
   * upper bounds: the mean volume is .25 to .40 of the bound at a radius-edge
   * ratio of 1.2, .35 to .46 at 1.414, .42 to .48 at 2; callers who want a mean
   * volume V ask for a bound of 4 V, 2.3 V or 2.2 V.
   */
  class Tetgen
  {
  public:
    /**
     * @throws InputError for parameters with which TetGen does not come to an
     *         end: a radius-edge ratio below 1.1, a dihedral angle above 20
     *         degrees (both seen on a cube), limits that are not positive.
     */
    explicit Tetgen(const scene::TetgenParameters &parameters);

    /**
     * Fills @p plc with tetrahedra. Before, the boundary is screened by
     * geometry::check_surface(); afterwards it is checked that there are cells,
     * that they fill the boundary's volume, and that each patch has its area and each
     * region cells.
     *
     * @param sizing cell_volumes must be empty; node_sizes are sizes at the
     *        points of @p plc.
     * @param report filled if not null.
     * @throws InputError if the input cannot be meshed, NumericalError if TetGen
     *         fails or its mesh does not pass the checks.
     */
    TetMesh
    mesh(const PiecewiseLinearComplex &plc,
         const Sizing                 &sizing,
         TetgenReport                 *report = nullptr) const;

    /**
     * Refines @p mesh, which has to be finalized. Its points stay the first
     * ones, bit by bit; patches, the boundary's shape and regions are kept. A
     * mesh that meets every wish is returned as it is, without a call of TetGen.
     * Checks are as in mesh(); volumes are compared to 1e-9.
     *
     * @throws InputError if sizes are missing, not finite or ask for more cells
     *         than the memory limit allows, NumericalError as mesh() does.
     */
    TetMesh
    refine(const TetMesh &mesh, const Sizing &sizing, TetgenReport *report = nullptr) const;

  private:
    scene::TetgenParameters parameters;
  };

  /** Warns of what TetGen could not do. */
  void
  warn_of_unmet_wishes(const TetgenReport &report, const core::Log &log);
} // namespace tetradapt::mesh

#endif
