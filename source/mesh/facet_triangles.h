// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_mesh_facet_triangles_h
#define tetradapt_source_mesh_facet_triangles_h

#include "tetradapt/geometry/surface_cutting.h"
#include "tetradapt/mesh/plc.h"

namespace tetradapt::mesh
{
  /** All facets as triangles, inner ones with the id one past the last patch's. */
  struct FacetTriangles
  {
    geometry::SurfaceMesh     surface;
    std::vector<unsigned int> facets; ///< of each triangle

    explicit FacetTriangles(const PiecewiseLinearComplex &plc);
  };

  /** @p plc with the triangles of @p cut in place of the facets that were cut. */
  PiecewiseLinearComplex
  with_cut_facets(const PiecewiseLinearComplex &plc,
                  const FacetTriangles         &triangles,
                  const geometry::CutSurface   &cut);
} // namespace tetradapt::mesh

#endif
