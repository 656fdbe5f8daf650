// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_reference_sampling_h
#define tetradapt_compare_reference_sampling_h

#include "tetradapt/compare/excluded_region.h"
#include "tetradapt/compare/point_locator.h"
#include "tetradapt/mechanics/energy_norm.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/hexahedral_field.h"

#include <mpi.h>

namespace tetradapt::compare
{
  /** A displacement on tetrahedra or on hexahedra: one of the two pointers is set. */
  struct ReferenceField
  {
    std::shared_ptr<const mesh::NodalField>      tetrahedra;
    std::shared_ptr<const mesh::HexahedralField> hexahedra;

    unsigned int
    degree() const
    {
      return hexahedra != nullptr ? hexahedra->degree() : tetrahedra->degree();
    }
    /** Number of tetrahedra; hexahedra count for six. */
    unsigned long
    n_tetrahedra() const
    {
      return hexahedra != nullptr ? 6ul * hexahedra->n_cells() : tetrahedra->mesh().n_cells();
    }
  };

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
    /**
     * @param materials must outlive this object.
     * @param excluded cells of it are neither visited nor do they count in the norms; empty for
     *        a reference on hexahedra.
     * Collective.
     */
    ReferenceSampling(const ReferenceField         &reference,
                      const mechanics::MaterialMap &materials,
                      MPI_Comm                      communicator,
                      ExcludedRegion                excluded = {});
    /** For one on tetrahedra. */
    ReferenceSampling(std::shared_ptr<const mesh::NodalField> reference,
                      const mechanics::MaterialMap           &materials,
                      MPI_Comm                                communicator,
                      ExcludedRegion                          excluded = {});

    const ExcludedRegion &
    excluded() const
    {
      return region;
    }

    /** The reference on hexahedra; null for one on tetrahedra. */
    const mesh::HexahedralField *
    hexahedra() const
    {
      return field.hexahedra.get();
    }
    /** The reference on tetrahedra, if it is one. */
    const mesh::NodalField &
    reference() const
    {
      return *field.tetrahedra;
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

    /** The locator of the reference's mesh of tetrahedra. Not collective. */
    const PointLocator &
    locator() const;

    /** The reference's tetrahedra that this rank visits, in this order. */
    const std::vector<unsigned int> &
    own_cells() const
    {
      return cells;
    }

    /** Norms of the reference u: L2, |grad u|, and mechanics::EnergyNorm. */
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
    /** EnergyNorm::noise. */
    double
    energy_noise() const
    {
      return mechanics::EnergyNorm::rounding * norms[3];
    }

  private:
    /** Each adds this rank's share of the norms' squares. */
    void
    visit_tetrahedra(std::vector<double> &sums);
    void
    visit_hexahedra(std::vector<double> &sums) const;

    ReferenceField                field;
    const mechanics::MaterialMap &material_map;
    MPI_Comm                      mpi_communicator;
    ExcludedRegion                region;
    std::vector<unsigned int>     cells;
    double                        norms[4] = {0., 0., 0., 0.}; ///< the last: int 2 mu |grad u|^2
    mutable std::unique_ptr<PointLocator> point_locator;
  };
} // namespace tetradapt::compare

#endif
