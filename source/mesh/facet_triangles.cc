// SPDX-License-Identifier: AGPL-3.0-or-later
#include "facet_triangles.h"

namespace tetradapt::mesh
{
  using Complex = PiecewiseLinearComplex;

  FacetTriangles::FacetTriangles(const Complex &plc)
  {
    surface.points = plc.points;
    for (unsigned int f = 0; f < plc.facets.size(); ++f)
      {
        const auto &v = plc.facets[f].vertices;
        for (std::size_t i = 2; i < v.size(); ++i)
          {
            surface.triangles.push_back({{v[0], v[i - 1], v[i]}});
            surface.ids.push_back(plc.facets[f].patch == Complex::inner ? plc.patches.size()
                                                                        : plc.facets[f].patch);
            facets.push_back(f);
          }
      }
  }

  Complex
  with_cut_facets(const Complex              &plc,
                  const FacetTriangles       &triangles,
                  const geometry::CutSurface &cut)
  {
    Complex result = plc;
    result.points  = cut.mesh.points;
    result.facets.clear();
    std::vector<bool> done(plc.facets.size(), false);
    for (std::size_t t = 0; t < cut.origin.size(); ++t)
      {
        const auto &v = cut.mesh.triangles[t];
        if (cut.origin[t] == geometry::CutSurface::nothing)
          {
            const unsigned int id = cut.mesh.ids[t];
            result.facets.push_back(
              {{v[0], v[1], v[2]}, id < plc.patches.size() ? id : Complex::inner});
            continue;
          }
        const unsigned int facet = triangles.facets[cut.origin[t]];
        if (!done[facet])
          result.facets.push_back(plc.facets[facet]);
        done[facet] = true;
      }
    return result;
  }
} // namespace tetradapt::mesh
