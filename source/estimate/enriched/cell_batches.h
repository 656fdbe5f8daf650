// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_enriched_cell_batches_h
#define tetradapt_estimate_enriched_cell_batches_h

#include "bernstein_kernel.h"

#include "tetradapt/compare/parallel.h"
#include "tetradapt/estimate/hierarchical_surplus.h"
#include "tetradapt/mechanics/material_map.h"

#include <map>
#include <vector>

namespace tetradapt::estimate
{
  /** Eight cells of one region, with their vertices sorted by point number, so that the
   * functions of edges point the same way in all cells. Missing cells have no volume. */
  template <unsigned int q>
  struct SurplusBatch
  {
    static constexpr unsigned int n = Bernstein<q>::n;

    CellBatchGeometry geometry;
    /** Numbers of the hierarchical functions of degree q: vertices, middles of edges
     * (q = 3), the surplus of edges, of faces (q = 3). */
    unsigned int       functions[n][n_lanes];
    unsigned int       cells[n_lanes];
    unsigned int       n_cells = 0;
    const VoigtMatrix *D       = nullptr;
  };

  /** The cells of a slice of a mesh in batches, of degree 2 or 3. */
  struct CellBatches
  {
    /** @param n_nodes of degree p: the first function of the surplus. */
    CellBatches(const HierarchicalSurplus    &surplus,
                unsigned int                  n_nodes,
                const mechanics::MaterialMap &materials,
                const compare::Slice         &slice);
    CellBatches(const CellBatches &) = delete;
    CellBatches &
    operator=(const CellBatches &)
      = delete;

    std::map<int, VoigtMatrix>   tangents; ///< per region; batches point to them
    std::vector<SurplusBatch<2>> quadratic;
    std::vector<SurplusBatch<3>> cubic;
  };

  /** Adds stiffness times @p x to @p forces. */
  void
  multiply_batches(const CellBatches &batches, const double *x, double *forces);

  /** products[cell] = a_K(x, y) for the cells of the batches. */
  void
  batch_products(const CellBatches &batches, const double *x, const double *y, double *products);

  /** Adds a_K(psi, psi) of the functions of the surplus to @p diagonal, nine numbers for each
   * function of the surplus. */
  void
  add_surplus_diagonal(const CellBatches &batches, unsigned int n_nodes, double *diagonal);
} // namespace tetradapt::estimate

#endif
