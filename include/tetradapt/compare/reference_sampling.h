// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_reference_sampling_h
#define tetradapt_compare_reference_sampling_h

#include "tetradapt/compare/point_locator.h"
#include "tetradapt/mechanics/material_map.h"

#include <mpi.h>

namespace tetradapt::compare
{
  /**
   * What a comparison needs of the reference and what does not change from cycle
   * to cycle: its norms, the order in which its cells are visited (along a curve
   * through space, so that successive quadrature points lie in the same or in
   * neighbouring cells of any other mesh), and a locator of its mesh, made when
   * it is first asked for. Build one for a reference and use it in every cycle.
   */
  class ReferenceSampling
  {
  public:
    /** Collective. @p materials must outlive this object. */
    ReferenceSampling(std::shared_ptr<const mesh::NodalField> reference,
                      const mechanics::MaterialMap           &materials,
                      MPI_Comm                                communicator);

    const mesh::NodalField &
    reference() const
    {
      return *field;
    }
    const mechanics::MaterialMap &
    materials() const
    {
      return material_map;
    }
    MPI_Comm
    communicator() const
    {
      return mpi_communicator;
    }

    /** The locator of the reference's mesh. Not collective. */
    const PointLocator &
    locator() const;

    /** The reference's cells that this rank visits, in this order. */
    const std::vector<unsigned int> &
    own_cells() const
    {
      return cells;
    }

    /** Norms of the reference u: L2, |grad u|, and sqrt(int eps:C:eps). */
    double
    l2_norm() const
    {
      return norms[0];
    }
    double
    h1_norm() const
    {
      return norms[1];
    }
    double
    energy_norm() const
    {
      return norms[2];
    }

  private:
    std::shared_ptr<const mesh::NodalField> field;
    const mechanics::MaterialMap           &material_map;
    MPI_Comm                                mpi_communicator;
    std::vector<unsigned int>               cells;
    double                                  norms[3] = {0., 0., 0.};
    mutable std::unique_ptr<PointLocator>   point_locator;
  };
} // namespace tetradapt::compare

#endif
