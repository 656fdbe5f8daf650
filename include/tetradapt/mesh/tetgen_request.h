// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_tetgen_request_h
#define tetradapt_mesh_tetgen_request_h

#include "tetradapt/mesh/plc.h"
#include "tetradapt/mesh/sizing.h"
#include "tetradapt/mesh/tetgen_protocol.h"
#include "tetradapt/scene/mesh_parameters.h"

namespace tetradapt::mesh
{
  /** Node sizes are multiplied by this before TetGen gets them: the mean
   * equivalent edge of its meshes is 1.21 times pointmtr at every quality bound. */
  constexpr double tetgen_size_factor = 0.83;

  /**
   * TetGen's input for filling a closed boundary. Patch p becomes marker p + 1,
   * because zero means "no marker". Segments are passed as edges, which TetGen keeps in
   * facets and inside. The switches are left to the caller.
   */
  TetgenRequest
  make_request(const PiecewiseLinearComplex &plc, const Sizing &sizing);

  /**
   * TetGen's input for refining a finalized mesh. Faces between two regions are
   * passed with the marker one past the last patch's. All edges where faces meet
   * at an angle, where patches or where regions meet, and those of kept lines, are passed as
   * segments: left alone, TetGen takes faces within 0.1 degree for one plane, and the
   * volume drifts.
   *
   * @param[out] n_inserted number of points that TetGen takes for ones that an
   *             earlier refinement inserted; it counts them against the cap -S.
   */
  TetgenRequest
  make_request(const TetMesh &mesh, const Sizing &sizing, unsigned long &n_inserted);

  /**
   * TetGen's switches for @p request.
   *
   * @param max_volume bound for all cells of a new mesh, ignored if not positive.
   * @param cap passed to -S unless negative.
   */
  std::string
  make_switches(const scene::TetgenParameters &parameters,
                const TetgenRequest           &request,
                double                         max_volume,
                long                           cap);
} // namespace tetradapt::mesh

#endif
